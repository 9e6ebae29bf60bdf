import math

import pytest

from bladerub.extras.explorer import figures
from bladerub.study.grid import CoatingCase


def test_figures_are_those_of_the_tables(coating, verdicts, runs):
    found = figures.of_runs(coating, verdicts, runs[::-1], spectrum_revolutions=10)
    assert found["growth_per_revolution"] == verdicts["growth_per_revolution"].tolist()
    assert found["divergent"] == verdicts["divergent"].tolist() == [False, True, True]
    assert found["revolutions"] == [20, 30, 6]
    assert found["run_key"] == ["key-0.1", "key-0.2", "key-0.3"]
    assert found["peak"] == pytest.approx([2, 2 * 1.03**19, 2 * 1.2**5])  # mm
    assert found["max_wear"] == [1e3 * float(depth) for depth in coating.max_wear]
    strongest = coating.spectrum_amplitude[0, 5:].argmax() + 5  # from order 0.5 up
    assert found["order"][0] == coating.spectrum_order[strongest]
    assert found["order_amplitude"][0] == 1e3 * coating.spectrum_amplitude[0, strongest]
    assert math.isnan(found["order_amplitude"][2])


def test_the_command_that_repeats_a_run():
    rigid = figures.command(CoatingCase.rigid("2nd", 0.15), [])
    assert rigid == "bladerub run --casing 2nd --coating rigid --friction 0.15"
    hostile = figures.command(CoatingCase("2; rm", 2.0, 1.0, 0.0), ["my study.yaml"])
    assert hostile == "bladerub run --config 'my study.yaml' --casing '2; rm' --E 2 --K 1 --theta 0"
