from pathlib import Path

import numpy as np
import pytest
import yaml

from bladerub.config.errors import ConfigError
from bladerub.extras.plots.rigs import rigs as draw
from bladerub.extras.rig.plan import PLAN, read_rigs
from bladerub.extras.rig.spec import MEASURABLE
from bladerub.extras.rig.table import compared, table

ROOT = Path(__file__).parents[4]


def rigs(folder, **changes):
    """Read the rigs of the repository with few passes and these changes of the first one."""
    plan = yaml.safe_load((ROOT / PLAN).read_text(encoding="utf-8"))
    for rig in plan["rigs"].values():
        rig["passes"] = min(rig["passes"], 3)
    next(iter(plan["rigs"].values())).update(changes)
    (folder / "rigs.yaml").write_text(yaml.safe_dump(plan, sort_keys=False), encoding="utf-8")
    return read_rigs(folder / "rigs.yaml")


def test_what_was_measured_stands_beside_what_is_computed(tmp_path):
    found = rigs(tmp_path, measured={"normal_force": 50.0, "worn_depth": 9e-5})
    passes = table(found)
    assert passes.rig.value_counts().to_dict() == {"spindle": 3, "sintered_seal": 3, "ballistic_bench": 1}
    assert passes.element_law[1].startswith("thermal (")
    beside = compared(found, passes)
    assert len(beside) == 3 * len(MEASURABLE)
    first = beside[beside.rig == "ballistic_bench"].set_index("quantity")
    assert first.measured_on_rig["normal_force"] == 50.0
    assert np.isnan(first.measured_on_rig["pass_energy"])
    assert first.computed["normal_force"] == passes.normal_force[0]
    crosses = [line for line in draw(passes, beside).axes[0].lines if line.get_marker() == "x"]
    assert [line.get_ydata().item() for line in crosses] == [50.0]


def test_a_problem_has_file_and_key(tmp_path):
    with pytest.raises(ConfigError, match=r"rigs.yaml:\d+: rigs.ballistic_bench.incursion = 0.005: must be"):
        rigs(tmp_path, incursion=5e-3)
