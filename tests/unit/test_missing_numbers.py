"""A run that ends in its first revolution, or a blade that never touches, leaves all other numbers there.

Of a coating of each kind in turn, and of a whole study, every table and figure is made, without a warning.
"""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from study_fixtures import *  # noqa: F403 (fixtures)
from study_fixtures import changed

from bladerub.extras.explorer.page import build
from bladerub.extras.maps.interface import Map
from bladerub.extras.variations.verdicts import margins, side_by_side, verdicts
from bladerub.io import tables
from bladerub.plots.histogram import peak_histogram
from bladerub.plots.maps import peak_sections, spectrum_map, wear_map
from bladerub.plots.polar import wear_profiles
from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import coating_cases, speeds
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.study.maps import write_map
from bladerub.study.peaks import peak_settings

pytestmark = pytest.mark.slow

QUICK = [
    {"casing": "2nd5nd", "E": [11], "K": [0.5], "theta": [0.0]},
    {"casing": "2nd", "E": [0.11, 1.1, 20], "K": [0.5, 5], "theta": [0.0]},
    {"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]},
    {"casing": "2nd", "coating": "rigid", "friction": [0.0]},
]
RANGE = (1e-6, 1e-3)
PAGE = {"max_frequency": 2.0, "amplitude_range": RANGE, "growth_revolutions": 10, "modulus_unit": 6e8}


def unbounded(coating, where):
    names = ("spectrum_amplitude", "revolution_amplitude", "revolution_peak")
    changed = {name: getattr(coating, name).copy() for name in names}
    for name in names:
        changed[name][where, name == "revolution_peak" :] = np.nan
    return replace(coating, **changed, status=np.where(where, "unbounded", coating.status))


def untouched(coating):
    names = ("wear", "wear_node", "spectrum_amplitude", "revolution_amplitude", "revolution_peak")
    still = {name: np.zeros_like(getattr(coating, name)) for name in (*names, "max_wear", "lobes")}
    return replace(coating, **still)


HOSTILE = {
    "unbounded at all speeds": lambda coating: unbounded(coating, coating.f_omega > 0),
    "unbounded about a peak": lambda coating: unbounded(coating, np.abs(coating.f_omega - 0.32) < 0.09),
    "without contact": untouched,
}


@pytest.fixture
def angle():
    return (np.arange(200) + 0.5) * (2 * np.pi / 200)


@pytest.fixture
def study(config):
    grid = {"start": 0.05, "stop": 0.4, "step": 0.05, "extra": [0.19, 0.197]}
    return changed(config, coatings=QUICK, speeds=grid, analysis={"histories": []})


@pytest.fixture
def sound(study, make_map):
    cases, f_omega = coating_cases(study), speeds(study)
    peaks = ({4: (0.3, 1e-4 + n * 1e-6), 6: (0.2, 1e-4)} for n in range(len(cases)))
    return [make_map(case, each, f_omega) for case, each in zip(cases, peaks, strict=True)]


@pytest.fixture
def accuracy(tmp_path):
    pd.DataFrame({"f_omega": 0.0, "mode": range(1, 8), "relative_error": 1e-4}).to_csv(tmp_path / "a.csv")
    return tmp_path / "a.csv"


def judged(study, maps, accuracy):
    made = {"peaks": peaks.table(study, maps), "divergence": divergence.table(study, maps)}
    rom_accuracy = pd.read_csv(accuracy)
    return made, findings.judge(Evidence(study, made | {"rom_accuracy": rom_accuracy}, maps)).set_index("id")


@pytest.mark.parametrize(("kind", "places"), [*zip(HOSTILE, ((0, 8), (1, 9), (7, 9)), strict=True)])
def test_one_bad_coating_takes_no_number_from_the_others(study, sound, kind, places, accuracy, tmp_path):
    whole, verdicts_of_all = judged(study, sound, accuracy)
    assert "reason" not in whole["peaks"]
    for place in places:
        coating = sound[place]
        maps = [*sound[:place], HOSTILE[kind](coating), *sound[place + 1 :]]
        made, found = judged(study, maps, accuracy)
        for name, table in made.items():
            tables.write(tmp_path / f"{name}.csv", table, {})
            own = table.casing == coating.case.casing
            for key in ("E", "K", "theta"):
                own &= table[key] == getattr(coating.case, key)
            expected = whole[name][~own]
            pd.testing.assert_frame_equal(table[~own][expected.columns], expected, check_dtype=False)
        missing = made["peaks"].f_peak.isna()
        assert missing.any() == ("reason" in made["peaks"])
        if missing.any():
            assert made["peaks"].reason[missing].str.contains("unbounded in|no vibration").all()
        assert set(found.index) <= set(verdicts_of_all.index)
        measured = pd.to_numeric(found.measured, errors="coerce")
        assert measured[found.measured.map(lambda each: isinstance(each, float))].notna().all()
        assert len(found) > len(verdicts_of_all) / 2


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=[pytest.mark.nightly] * ("peak" not in kind)) for kind in HOSTILE]
)
def test_every_figure_and_page_is_made(study, sound, kind, accuracy, tmp_path):
    maps = [HOSTILE[kind](coating) for coating in sound]
    made, _ = judged(study, maps, accuracy)
    settings = peak_settings(study, "2nd")
    figures = [wear_profiles([each for each in maps if each.case.E == 2], [0.19, 0.197])[1]]
    for coating in maps[-2:]:
        figures += [wear_map(coating), spectrum_map(coating, RANGE, 2.0), Map(coating).plot_spectrum()]
        figures.append(peak_sections(coating, settings, RANGE, 2.0)[1])
    layer = made["peaks"].query("casing == '2nd' and theta == 0 and E < 1e9")
    figures += [peak_histogram(layer, quantity, 4, 6e8)[1] for quantity in ("amplitude", "f_peak")]
    paths = [tmp_path / f"{coating.case.name}.h5" for coating in maps]
    manifests = [path.with_suffix(".tsv") for path in paths]
    for path, coating in zip(paths, maps, strict=True):
        write_map(path, coating, {})
        rows = [ManifestRow(f"{f}.h5", f, "key", "completed", 1) for f in coating.f_omega]
        write_manifest(path.with_suffix(".tsv"), rows)
    figures.append(verdicts(side_by_side(margins(study, paths, accuracy), by="variation")))
    for figure in figures:
        figure.draw_without_rendering()
    page = build(paths, manifests, made["peaks"], made["divergence"], PAGE | {"spectrum_revolutions": 10}, [])
    assert "NaN" not in page.partition("<script")[0]
