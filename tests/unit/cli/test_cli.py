import io
import json
import math
import re
import subprocess
import sys
from argparse import Namespace

import numpy as np
import pandas as pd
import pytest

import bladerub.command
from bladerub.blade.validation import read_reduced_blade
from bladerub.cli import inputs, main
from bladerub.io.hdf5 import read_attributes
from bladerub.study.store import read_run

RUN = ["run", "--casing", "2nd", "--E", "2", "--K", "0.5", "--theta", "0.15", "--f", "0.19"]

pytestmark = pytest.mark.usefixtures("at_home")


@pytest.fixture
def small(folder):
    return ["--config", folder / "small.yaml", "--revolutions", "2"]


@pytest.fixture
def blade_file(small, folder, command):
    path = folder / "results" / "blade" / "reduced_model.h5"
    if not path.exists():
        assert command(*RUN, *small)[0] == 0
    return path


def test_run_builds_the_blade_if_there_is_none(small, folder, command):
    blade = folder / "results" / "blade"
    assert not blade.exists()
    code, out, err = command(*RUN, *small, "--json")
    assert (code, err) == (0, f"bladerub run: building the blade first, into {blade}\n")
    assert json.loads(out)["status"] == "completed"
    assert {path.name for path in blade.iterdir()} >= {"reduced_model.h5", "mesh.h5", "rom_accuracy.csv"}


def test_a_run_may_be_replaced_but_nothing_else(small, blade_file, folder, command, refusal):
    for _ in range(2):
        assert command(*RUN, *small, "--output", folder / "again.h5")[0] == 0
    before = blade_file.read_bytes()
    line = refusal(*RUN, *small, "--output", blade_file)
    assert line.startswith(f"bladerub run: --output {blade_file}: is there and is no run, ")
    assert blade_file.read_bytes() == before


@pytest.mark.extras
def test_the_stress_of_a_run_is_that_of_its_motion(small, blade_file, folder, figures):
    path, overlay = folder / "stressed.h5", folder / "last.yaml"
    few = "analysis: {spectrum_revolutions: 1, max_order: 20}\n"
    overlay.write_text((folder / "small.yaml").read_text() + few)
    stress = figures(*RUN, *small, "--config", overlay, "--stress", "--output", path)["stress"]
    for name in ("von_mises", "principal"):
        assert 0 < stress["static"][name] < min(stress["start_up"][name], stress["last"][name])
        assert 0 < stress["start_up"][f"{name}_time"] <= 1 < stress["last"][f"{name}_time"] <= 2
    kept = read_attributes(path)
    assert kept["stress_last_alternating"] == stress["last"]["alternating"]
    assert kept["stress_start_up_von_mises_time"] == stress["start_up"]["von_mises_time"]
    # the same by the other way to it: all nodes of the mesh at instants of the last revolution
    motion = ["--vtu", folder / "motion", "--samples", "200"]
    exported = figures("export", "--run", path, "--config", overlay, *motion)
    for name in ("von_mises", "principal"):
        assert stress["last"][name] == pytest.approx(exported[f"largest_{name}"], rel=0.02)


def test_a_speed_in_revolutions_a_minute_is_the_same_run(small, blade_file, figures):
    by_f, rpm = figures(*RUN, *small), 60 * 0.19 * read_reduced_blade(blade_file).f1_hz
    by_rpm = figures(*RUN[:-2], "--rpm", repr(rpm), *small)
    assert by_f["rpm"] == pytest.approx(rpm)
    assert by_rpm["f_omega"] == pytest.approx(0.19, rel=1e-12)
    assert by_rpm["max_wear"] == pytest.approx(by_f["max_wear"], rel=1e-6)
    in_units = ["--f", f"{rpm:.4f}rpm", "--E", "1.2 GPa", "--K", "300MPa"]
    assert figures(*RUN, *in_units, *small)["run_key"] == by_f["run_key"]


@pytest.mark.extras
def test_an_ensemble_shows_its_bands(small, blade_file, figures):
    bands = figures(*RUN, *small, "--ensemble", "2")["ensemble"]
    assert bands["runs"] == 3
    assert bands["max_wear"]["low"] <= bands["max_wear"]["median"] <= bands["max_wear"]["high"]


@pytest.mark.extras
def test_a_row_shows_its_blades(small, blade_file, folder, figures, refusal):
    row = ["--blades", "3", "--length-scatter", "2e-5", "--frequency-scatter", "0.01", "--coupling", "0.01"]
    found = figures(*RUN, *small, *row, "--output", folder / "row.h5")
    blades = pd.DataFrame(found["blades"]).set_index("blade")
    assert blades.length.nunique() == blades.frequency.nunique() == 3
    stored = read_run(folder / "row.h5")
    assert stored.attributes["disk_energy"] != 0
    np.testing.assert_array_equal(stored.data["blade_length"], blades.length)
    assert figures(*RUN, *small, *row, "--seed", "2")["blades"] != found["blades"]
    line = refusal(*RUN, *small, "--blades", "200")
    assert "row: blades 1 and 2 are 10 of 2000 coating elements apart" in line


@pytest.mark.slow
def test_run_with_another_law_says_so(small, blade_file, folder, command):
    path = folder / "thermal.h5"
    values = "heat_capacity=2e6 conductivity=5 heated_depth=1e-4 friction_share=0.5 softening_rise=500"
    values += " softening_exponent=1"
    law = [word for value in values.split() for word in ("--law-parameter", value)]
    code, words, _ = command(*RUN, "--law", "thermal", *law, "--output", path, *small)
    assert code == 0
    warmest = float(re.search(r"largest temperature rise  +([\d.]+) K", words)[1])
    stored = read_run(path)
    assert stored.data["temperature_rise"].max() == pytest.approx(warmest, rel=1e-2)
    assert stored.attributes["element_law"].startswith("thermal (heat_capacity 2e+06, conductivity 5, ")


def test_what_is_not_finite_is_null_in_json(capsys):
    inputs.show(Namespace(json=True), {"E": math.inf, "rows": [1.0, math.nan]}, str)
    assert json.loads(capsys.readouterr().out) == {"E": None, "rows": [1.0, None]}


def test_interruption_leaves_no_traceback(small, blade_file, monkeypatch, command):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("bladerub.contact.run.simulate_longer", interrupted)
    assert command(*RUN, *small) == (130, "", "bladerub run: interrupted\n")


def test_a_blade_that_is_damaged_or_of_another_config_is_named_and_made_anew_when_deleted(
    small, blade_file, folder, command, refusal
):
    (folder / "longer.yaml").write_text("blade: {length: 0.4}\n")
    line = refusal(*RUN, *small, "--config", folder / "longer.yaml")
    assert line.startswith(f"bladerub run: {blade_file}: was built from another config; ")
    path = blade_file.with_name("mesh.h5")
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    assert refusal(*RUN, *small).startswith(f"bladerub run: {path}: not a readable HDF5 file")
    for lost in (path, path.with_name("rom_accuracy.csv")):
        lost.unlink()
        assert command(*RUN, *small)[0] == 0
        assert lost.exists()
    assert path.read_bytes() == whole


@pytest.mark.extras
def test_a_reader_that_ends_early_is_no_error(tmp_path):
    overlay = tmp_path / "nowhere.yaml"
    overlay.write_text("results: nowhere\n")
    program = "import sys; from bladerub.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "status", "--config", str(overlay)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait() == 0


@pytest.mark.extras
def test_every_text_can_be_printed_in_any_locale(monkeypatch):
    text = "θ = 0.15, 10 µm, M\udcfcller.inp"  # a name of other bytes
    stream = io.TextIOWrapper(io.BytesIO(), "ascii")
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setattr("bladerub.extras.status.command.status", lambda options: print(text))
    assert main(["status"]) == 0
    assert stream.buffer.getvalue() == f"{text}\n".encode("utf-8", "surrogateescape")


def test_interruption_while_it_is_imported_leaves_no_traceback(monkeypatch, capsys):
    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr("bladerub.cli.main", interrupted)
    assert bladerub.command.main() == 130
    assert capsys.readouterr() == ("", "bladerub: interrupted\n")
