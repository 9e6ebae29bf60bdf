import base64
import gzip
import hashlib
import json
import math
import re
from dataclasses import asdict, replace

import numpy as np
import pandas as pd
import pytest
from study_fixtures import changed

from bladerub.extras.explorer.coating import AMPLITUDE_FLOOR, command, of_runs, parts
from bladerub.extras.explorer.page import build
from bladerub.study import divergence
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.study.maps import write_map


@pytest.fixture
def coating(make_map, case):
    """Three speeds: steady; growing and repeated for longer; out of bounds in the sixth revolution."""
    longer = np.full((3, 30), np.nan)
    longer[1] = 1e-3 * 1.03 ** np.arange(30)
    status = ["completed", "completed", "unbounded"]
    made = make_map(case, {}, [0.1, 0.2, 0.3], [2, 4, 4], [0.0, 0.03, 0.2], status, 1e-3, longer)
    made.revolution_amplitude[2, 6:] = np.nan
    spectrum = 10 ** np.random.default_rng(3).uniform(-9, -2, (3, 301))
    spectrum[2] = np.nan
    spectra = {"spectrum_order": np.arange(301) / 10, "spectrum_amplitude": spectrum}
    few = {"angle": made.angle[::40], "wear": made.wear[:, ::40], "wear_node": made.wear_node[..., ::40]}
    return replace(made, **spectra, **few, revolution_peak=2 * made.revolution_amplitude)


@pytest.fixture
def verdicts(coating, config):
    growth = {"growth": 0.01, "revolutions": 10, "confidence": 0.95, "confirmation_revolutions": 30}
    return divergence.table(changed(config, analysis={"divergence": growth}), [coating])


@pytest.fixture
def runs(coating):
    by_speed = zip(coating.f_omega, coating.status, strict=True)
    return [ManifestRow(f"{f:.4f}.h5", f, f"key-{f}", status, 1) for f, status in by_speed]


def test_figures_are_those_of_the_tables_and_come_back_from_the_page(coating, verdicts, runs):
    found = of_runs(coating, verdicts, runs[::-1], spectrum_revolutions=10)
    assert found["divergent"] == verdicts["divergent"].tolist() == [False, True, True]
    assert found["revolutions"] == [20, 30, 7]  # it ended in the seventh
    assert found["run_key"] == ["key-0.1", "key-0.2", "key-0.3"]
    assert found["peak"] == pytest.approx([2, 2 * 1.03**19, 2 * 1.2**5])  # mm
    strongest = coating.spectrum_amplitude[0, 5:].argmax() + 5  # from order 0.5 up
    assert found["order"][0] == coating.spectrum_order[strongest]
    assert found["order_amplitude"][0] == 1e3 * coating.spectrum_amplitude[0, strongest]
    assert math.isnan(found["order_amplitude"][2])
    packed = parts(coating, verdicts, runs, 10, max_frequency=2.5)
    data = {name: gzip.decompress(base64.b64decode(text)) for name, text in packed.items()}
    numbers = json.loads(data["figures"])
    steps = np.cumsum(np.frombuffer(data["wear"], np.uint8).reshape(3, -1), axis=1, dtype=np.uint8)
    deepest = np.array(numbers["deepest"])[:, None]
    assert (np.abs(steps / 255 * deepest - 1e3 * coating.wear) <= deepest / 509).all()
    low, high = numbers["spectrum_range"]
    codes = np.frombuffer(data["spectrum"], np.uint8)[:252]  # to order 25 at the first speed, and a cell
    amplitude = low * (high / low) ** ((codes - 1.0) / 254)
    shown = 1e3 * np.maximum(coating.spectrum_amplitude[0, :252], AMPLITUDE_FLOOR)
    np.testing.assert_allclose(amplitude, shown, rtol=0.03)
    assert not np.frombuffer(data["spectrum"], np.uint8)[-132:].any()  # the last run has no spectrum
    low, high = numbers["growth_range"]
    codes = np.frombuffer(data["growth"], "<u2").reshape(3, 50)
    amplitude = np.where(codes, low * (high / low) ** ((codes - 1.0) / 65534), np.nan)
    np.testing.assert_allclose(amplitude[:, :20], 1e3 * coating.revolution_amplitude, rtol=1e-3)
    np.testing.assert_allclose(amplitude[:, 20:], 1e3 * coating.confirmation_amplitude, rtol=1e-3)
    assert numbers["runs"]["growth_per_revolution"] == verdicts["growth_per_revolution"].tolist()


def test_the_command_that_repeats_a_run():
    rigid = command(CoatingCase.rigid("2nd", 0.15), [])
    assert rigid == "bladerub run --casing 2nd --coating rigid --friction 0.15"
    hostile = command(CoatingCase("2; rm", 2.0, 1.0, 0.0), ["my study.yaml"])
    assert hostile == "bladerub run --config 'my study.yaml' --casing '2; rm' --E 2 --K 1 --theta 0"


SETTINGS = {"max_frequency": 2.5, "amplitude_range": [2e-6, 3e-3], "growth_revolutions": 10}
SETTINGS |= {"spectrum_revolutions": 10, "modulus_unit": 6e8, "f1_hz": 193.0}
SETTINGS |= {"doubts": ["eq. (2) is up to 3.9 % off"]}


def test_the_page_holds_every_coating_runs_only_its_own_scripts_and_a_hostile_name_adds_no_markup(
    coating, verdicts, runs, tmp_path
):
    def scripts(page, kind):
        return re.findall(rf'<script type="{kind}"[^>]*>(.*?)</script>', page, re.DOTALL)

    def page(*coatings):
        maps, manifests = ([tmp_path / f"{at}{of}" for at in range(len(coatings))] for of in (".h5", ".tsv"))
        for path, manifest, each in zip(maps, manifests, coatings, strict=True):
            write_map(path, each, {})
            write_manifest(manifest, runs)
        cases = [asdict(each.case) for each in coatings]
        peaks = pd.DataFrame(cases).assign(order=4, f_peak=0.2, amplitude=1.25e-3)
        table = pd.concat([verdicts.assign(**case) for case in cases])
        return build(maps, manifests, peaks, table, SETTINGS, [])

    other = replace(coating, case=CoatingCase.rigid("2nd", 0.0))
    text = page(coating, other)
    (study,) = scripts(text, "application/json")
    first, second = json.loads(study)["coatings"]
    assert first["name"] == coating.case.name
    assert (second["E"], second["rigid"], second["friction"]) == (None, True, 0.0)
    without = {"reason": None, "draws": None, "low": None, "high": None}
    assert first["peaks"] == [{"order": 4, "f": 0.2, "Y": 1.25} | without]
    assert len(scripts(text, "application/gzip")) == 8
    assert re.findall(r"<(?:script|link|img|iframe)[^>]*\b(?:src|href)=", text) == []
    assert text == page(coating, other)
    text = page(coating)
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    programs = re.findall(r"<script>(.*?)</script>", text, re.DOTALL) + scripts(text, "module")
    digests = [base64.b64encode(hashlib.sha256(each.encode()).digest()).decode() for each in programs]
    assert len(digests) == 2
    assert f"script-src 'sha256-{digests[0]}' 'sha256-{digests[1]}';" in policy
    assert policy.startswith("default-src 'none';")
    hostile = '</script><script>alert(1)</script><img src="x">'
    text = page(replace(coating, case=CoatingCase(hostile, 2.0, 0.5, 0.15)))
    assert "alert(1)</script>" not in text
    assert "<img" not in text.split("<script>")[0]
    (study,) = scripts(text, "application/json")
    assert json.loads(study)["coatings"][0]["casing"] == hostile
