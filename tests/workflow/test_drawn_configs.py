"""Whatever config passes the checks, all of its study can be planned."""

from contextlib import suppress

import pytest
import yaml
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, read
from bladerub.extras.chart.plan import check
from bladerub.io.errors import BadInput
from bladerub.io.folders import ROOT

STUDY = ROOT / "config" / "config.yaml"
COUNTERS = st.lists(st.integers(1, 24), min_size=1, max_size=3, unique=True)
THREE_LOBES = {"casings": {"2nd": {"nodal_diameters": [3]}}}
HIGH_SPEEDS = {"speeds": {"start": 0.3, "stop": 0.8, "step": 0.1}, "reduction": {"f_omega_max": 0.8}}
LOW_SPEEDS = {"speeds": {"start": 0.05, "stop": 0.12, "step": 0.01}, "reduction": {"f_omega_max": 0.15}}
HIGH_SPEEDS["speeds"]["extra"] = LOW_SPEEDS["speeds"]["extra"] = []


def numbers(value, path=()):
    if isinstance(value, dict):
        for name, inner in value.items():
            yield from numbers(inner, (*path, name))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, value


@st.composite
def changed_numbers(draw):
    overlay = {}
    for path, value in draw(st.lists(st.sampled_from(list(numbers(load(STUDY)))), max_size=3)):
        number = value * draw(st.sampled_from([0, 0.5, 0.9, 1.25, 2]))
        inner = overlay
        for name in path[:-1]:
            inner = inner.setdefault(name, {})
        inner[path[-1]] = round(number) if isinstance(value, int) else number
    return overlay


@st.composite
def casing(draw):
    diameters = draw(COUNTERS)
    return {
        "nodal_diameters": diameters,
        "weights": [draw(st.sampled_from([0.2, 0.5, 1.0])) for _ in diameters],
        "amplitude": draw(st.floats(2e-4, 1e-3)),
        "interference": draw(st.floats(1e-4, 4e-4)),
        "start_angle": draw(st.sampled_from([0.0, 90.0, -12.5])),
        **draw(st.fixed_dictionaries({}, optional={"peak_orders": COUNTERS, "bump_width": st.just(0.2)})),
    }


@st.composite
def coating(draw, name):
    sliding = draw(st.sampled_from([{"friction": [0.0]}, {"friction": [0.15]}, {"theta": [0.0, 0.15]}]))
    if "friction" in sliding and draw(st.booleans()):
        return {"casing": name, "coating": "rigid", **sliding}
    E = draw(st.lists(st.integers(1, 200).map(lambda n: n / 10), min_size=1, max_size=2, unique=True))
    K = draw(st.sampled_from([[0.5], [0, 5], [0.05, 1e-5]]))
    return {"casing": name, "E": E, "K": K, **sliding}


@st.composite
def studies(draw):
    """A config that lies over that of the study, and agrees with itself more often than not."""
    overlay = draw(changed_numbers())
    if draw(st.booleans()):
        names = draw(st.sampled_from([["2nd"], ["oval"], ["Casing9", "2nd"]]))
        overlay["casings"] = {name: draw(casing()) for name in names}
        overlay["coatings"] = [draw(coating(name)) for name in names]
    if draw(st.booleans()):
        start, step = draw(st.sampled_from([0.05, 0.1, 0.3])), draw(st.sampled_from([0.005, 0.01, 0.05]))
        overlay["speeds"] = {"start": start, "stop": start + 0.1, "step": step, "extra": []}
    return overlay


def is_planned(workspace, overlay):
    path = workspace.folder / "overlay.yaml"
    path.write_text(yaml.safe_dump(overlay), encoding="utf-8")
    try:
        config = read(STUDY, path)
    except ConfigError:
        return  # other tests look at what it says
    targets = ["all"]
    with suppress(BadInput):  # not every study can have a chart
        check(config)
        targets.append("chart")
    workspace.dry_run(*targets, "--quiet", config=overlay)


@pytest.mark.nightly
@settings(
    max_examples=500,  # some 300 are valid
    deadline=None,
    database=None,
    derandomize=True,
    phases=[Phase.generate],  # each example is a call of snakemake: none to make a failed one smaller
    suppress_health_check=list(HealthCheck),
)
@given(overlay=studies())
def test_hundreds_of_studies_are_planned(workspace, overlay):
    is_planned(workspace, overlay)


@pytest.mark.parametrize("overlay", [THREE_LOBES, HIGH_SPEEDS, LOW_SPEEDS])
def test_other_engine_orders_and_speeds_are_planned(workspace, overlay):
    is_planned(workspace, overlay)
