from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from bladerub.extras.verification import more_nodes, response
from bladerub.study.peaks import COLUMNS


@pytest.fixture
def table(blade, config, make_result, monkeypatch):
    """The table of a response whose peak is at 0.31, higher and with deeper wear the more nodes there are."""
    blades = {n: replace(blade, eta=n) for n in more_nodes.NODES}

    def simulate(blade, spec):
        peak = 1e-3 * (1 - abs(spec.f_omega - 0.31))
        return make_result(amplitude=peak * blade.eta / 8, depth=1e-4 * blade.eta / 8)

    monkeypatch.setattr(more_nodes, "blade_with", lambda _, n: blades[n])
    for module in (response, more_nodes):
        monkeypatch.setattr(module, "simulate", simulate)
    rows = [["2nd", 2.0, 0.5, 0.15, 6, 0.31, 1e-3, "theta"], ["2nd", 2.0, 1.0, 0.0, 6, 0.31, 1e-3, "theta"]]
    return more_nodes.table(config, pd.DataFrame(rows, columns=COLUMNS))


def test_each_number_of_nodes_has_a_row_for_each_listed_peak(table):
    assert table.interface_nodes.tolist() == [8, 16, 24]
    assert table.f_peak.tolist() == [0.31] * 3
    np.testing.assert_allclose(table.amplitude_change, [0, 1, 2], atol=1e-9)
    np.testing.assert_allclose(table.volume_change, [0, 1, 2], atol=1e-9)
    np.testing.assert_allclose(table.wear_difference, [0, 1, 2], atol=1e-9)
    assert (table.cpu_s >= 0).all()


def test_a_blade_has_the_nodes_and_the_mesh_that_it_is_asked_for(config, monkeypatch):
    monkeypatch.setattr(more_nodes, "compile_kernel", lambda n_nodes, law: None)
    monkeypatch.setattr(more_nodes, "build", lambda config: type("Built", (), {"reduced": config}))
    made = more_nodes.blade_with(config, 16)
    assert made["reduction"]["interface_nodes"] == 16
    assert made["blade"]["mesh"]["chordwise"] == 24
    assert "interface_nodes" not in config["reduction"]
