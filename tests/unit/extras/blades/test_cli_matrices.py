"""``bladerub export --fe-matrices`` and ``bladerub import`` of what it writes."""

import shutil

import meshio
import numpy as np
import pytest
import yaml

from bladerub.cli import inputs, main
from bladerub.io import hdf5


@pytest.fixture(scope="module")
def written(folder):
    words = ["export", "--config", folder / "small.yaml", "--fe-matrices", folder / "m"]
    assert main([str(word) for word in [*words, "--speeds", 0.1, 0.3, "--matrix-format", "npz"]]) == 0
    return folder


def test_what_is_written_can_be_looked_at(written, figures):
    names = {path.stem for path in (written / "m").iterdir()} - {"nodes", "mass"}
    assert names == {f"stiffness_{name}" for name in ("rest", "at_0.1", "half", "at_0.3", "max")}
    told = figures("import", written / "m")
    assert told["f1_hz"] == pytest.approx(195.313, abs=1e-3)
    assert told["length"] == pytest.approx(0.2, rel=0.01)
    assert told["config"]["blade"]["source"]["matrices"] == str(written / "m")


def test_what_it_prints_is_a_config_of_the_blade(written, command, refusal, tmp_path):
    code, out, _ = command("import", written / "m", "--matrix-units", "inch-lbf")
    assert code == 0
    assert "warning             its mass is" in out
    (tmp_path / "printed.yaml").write_text(out.split("are absolute\n")[1])
    assert command("import", written / "m", "--config", tmp_path / "printed.yaml") == (0, out, "")
    refusal("import", written / "m", "--omega-max", "400")
    assert "376.991 rad/s" in refusal("import", written / "m", "--omega-max", "60 Hz")


def test_a_blade_without_elements_goes_to_programs_that_need_none(
    written, command, refusal, tmp_path, monkeypatch
):
    monkeypatch.setattr(inputs, "study_folder", lambda: tmp_path)
    shutil.copytree(written / "m", tmp_path / "m")
    source = {"source": {"matrices": str(tmp_path / "m")}}
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump({"blade": source}))
    words = ("export", "--config", tmp_path / "mine.yaml")
    assert command(*words, "--mesh", tmp_path / "blade.vtu")[0] == 0
    mesh = meshio.vtu.read(tmp_path / "blade.vtu")
    data, _ = hdf5.read(tmp_path / "results" / "blade" / "mesh.h5")
    assert [block.type for block in mesh.cells] == ["vertex"]
    np.testing.assert_array_equal(mesh.points, data["points"])
    modes = [name for name in mesh.point_data if name.startswith("mode_")]
    np.testing.assert_array_equal(mesh.point_data[modes[1]], data["mode_shape"][1])
    assert command(*words, "--matrices", tmp_path / "blade.npz")[0] == 0
    before = sorted(tmp_path.iterdir())
    for option, name in (("--calculix", "decks"), ("--mesh", "blade.inp"), ("--fe-matrices", "again")):
        line = refusal(*words, option, tmp_path / name)
        assert "of matrices" in line
        assert "without elements" in line
    assert sorted(tmp_path.iterdir()) == before
