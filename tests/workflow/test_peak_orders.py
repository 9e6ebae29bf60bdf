"""Configs whose peaks are at other engine orders than the paper's are planned."""

import pytest


@pytest.mark.parametrize(
    "overlay",
    [
        {"casings": {"2nd": {"nodal_diameters": [3]}}},
        {"speeds": {"start": 0.3, "stop": 0.8, "step": 0.1, "extra": []}, "reduction": {"f_omega_max": 0.8}},
    ],
)
def test_other_engine_orders_are_planned(workspace, overlay):
    done = workspace.snakemake("all", "chart", "--dry-run", "--quiet", config=overlay)
    assert done.returncode == 0, done.stderr
