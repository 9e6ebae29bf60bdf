import io
import json
import re
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from bladerub.api.map import solve_all
from bladerub.blade.validation import read_reduced_blade
from bladerub.cli import inputs, main
from bladerub.extras.ensembles import interface
from bladerub.io.hdf5 import read_attributes
from bladerub.study.store import read_run

RUN = ["run", "--casing", "2nd", "--E", "2", "--K", "0.5", "--theta", "0.15", "--f", "0.19"]


@pytest.fixture
def small(folder, monkeypatch):
    monkeypatch.setattr(inputs, "study_folder", lambda: folder)
    return ["--config", str(folder / "small.yaml"), "--revolutions", "2"]


@pytest.fixture
def blade_file(small, folder, capsys):
    path = folder / "results" / "blade" / "reduced_model.h5"
    if not path.exists():
        assert main([*RUN, *small]) == 0
        capsys.readouterr()
    return path


def test_run_builds_the_blade_if_there_is_none(small, folder, capsys):
    assert not (folder / "results").exists()
    assert main([*RUN, *small, "--json"]) == 0
    output = capsys.readouterr()
    assert output.err == f"bladerub run: building the blade first, into {folder / 'results' / 'blade'}\n"
    assert json.loads(output.out)["status"] == "completed"
    assert (folder / "results" / "blade" / "mesh.h5").is_file()
    assert (folder / "results" / "blade" / "rom_accuracy.csv").is_file()


def test_a_run_may_be_replaced_but_nothing_else(small, blade_file, folder, capsys, command):
    path = folder / "again.h5"
    for _ in range(2):
        assert main([*RUN, *small, "--output", str(path)]) == 0
    capsys.readouterr()
    before = blade_file.read_bytes()
    code, _, line = command(*RUN, *small, "--output", str(blade_file))
    assert code == 2
    assert line.startswith(f"bladerub run: --output {blade_file}: is there and is no run, ")
    assert blade_file.read_bytes() == before


def test_the_stress_of_a_run_is_that_of_its_motion(small, blade_file, folder, capsys):
    path = folder / "stressed.h5"
    overlay = folder / "last.yaml"
    few = "analysis: {spectrum_revolutions: 1, max_order: 20}\n"
    overlay.write_text((folder / "small.yaml").read_text() + few)
    arguments = [*RUN, "--config", str(overlay), "--revolutions", "2", "--stress"]
    assert main([*arguments, "--json", "--output", str(path)]) == 0
    stress = json.loads(capsys.readouterr().out)["stress"]
    for name in ("von_mises", "principal"):
        assert 0 < stress["static"][name] < min(stress["start_up"][name], stress["last"][name])
        assert 0 < stress["start_up"][f"{name}_time"] <= 1 < stress["last"][f"{name}_time"] <= 2
    kept = read_attributes(path)
    assert kept["stress_last_alternating"] == stress["last"]["alternating"]
    assert kept["stress_start_up_von_mises_time"] == stress["start_up"]["von_mises_time"]
    # the same by the other way to it: all nodes of the mesh at instants of the last revolution
    motion = ["export", "--run", str(path), "--config", str(overlay), "--vtu", str(folder / "motion")]
    assert main([*motion, "--samples", "200", "--json"]) == 0
    exported = json.loads(capsys.readouterr().out)
    for name in ("von_mises", "principal"):
        assert stress["last"][name] == pytest.approx(exported[f"largest_{name}"], rel=0.02)


def test_a_speed_in_revolutions_a_minute_is_the_same_run(small, blade_file, capsys):
    def figures(*words):
        assert main([*words, *small, "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    by_f, rpm = figures(*RUN), 60 * 0.19 * read_reduced_blade(blade_file).f1_hz
    by_rpm = figures(*RUN[:-2], "--rpm", repr(rpm))
    assert by_f["rpm"] == pytest.approx(rpm)
    assert by_rpm["f_omega"] == pytest.approx(0.19, rel=1e-12)
    assert by_rpm["max_wear"] == pytest.approx(by_f["max_wear"], rel=1e-6)
    in_units = {"--f": f"{rpm:.4f}rpm", "--E": "1.2 GPa", "--K": "300MPa"}
    typed = [in_units.get(option, value) for option, value in zip(["", *RUN], RUN, strict=False)]
    assert figures(*typed)["run_key"] == by_f["run_key"]


def test_an_ensemble_shows_its_bands(small, blade_file, capsys, monkeypatch):
    further = []

    def solved(blade, runs, *more):
        further.extend(runs)
        return solve_all(blade, runs, *more)

    monkeypatch.setattr(interface, "solve_all", solved)
    assert main([*RUN, *small, "--ensemble", "2", "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    bands = figures["ensemble"]
    assert (bands["runs"], len(further)) == (3, 2)  # the run itself is made once
    assert bands["max_wear"]["low"] <= bands["max_wear"]["median"] <= bands["max_wear"]["high"]


def test_a_row_shows_its_blades(small, blade_file, folder, capsys):
    output = folder / "row.h5"
    given = ["--blades", "3", "--length-scatter", "2e-5", "--frequency-scatter", "0.01", "--coupling", "0.01"]

    def shown(*more):
        assert main([*RUN, *small, *given, "--json", *more]) == 0
        return json.loads(capsys.readouterr().out)

    found = shown("--output", str(output))
    blades = pd.DataFrame(found["blades"]).set_index("blade")
    assert list(blades.index) == [1, 2, 3]
    assert blades.length.nunique() == blades.frequency.nunique() == 3
    assert found["blade"] == blades.amplitude.idxmax()
    stored = read_run(output)
    assert stored.attributes["disk_energy"] != 0
    np.testing.assert_array_equal(stored.data["blade_length"], blades.length)
    assert shown("--seed", "2")["blades"] != found["blades"]


@pytest.mark.slow
def test_run_with_another_law_says_so(small, blade_file, folder, capsys):
    path = folder / "thermal.h5"
    values = "heat_capacity=2e6 conductivity=5 heated_depth=1e-4 friction_share=0.5 softening_rise=500"
    values += " softening_exponent=1"
    law = [word for value in values.split() for word in ("--law-parameter", value)]
    assert main([*RUN, "--law", "thermal", *law, "--output", str(path), *small]) == 0
    words = capsys.readouterr().out
    warmest = float(re.search(r"largest temperature rise  +([\d.]+) K", words)[1])
    stored = read_run(path)
    assert stored.data["temperature_rise"].max() == pytest.approx(warmest, rel=1e-2)
    assert stored.attributes["element_law"].startswith("thermal (heat_capacity 2e+06, conductivity 5, ")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([*RUN, "--f", "9000 rpm"], "(9000 rpm): must be at most reduction.f_omega_max = 0.4"),
        ([*RUN, "--blades", "200"], "row: blades 1 and 2 are 10 of 2000 coating elements apart"),
        ([*RUN, "--coupling", "0.1"], "--coupling = 0.1: goes with --blades only"),
        ([*RUN, "--law", "viscoplastic"], '--law = "viscoplastic": viscosity: missing'),
        ([*RUN, "--law-parameter", "viscosity"], "--law-parameter = viscosity: must be NAME=VALUE"),
    ],
)
def test_bad_input_is_answered_in_one_line(small, blade_file, arguments, words, command):
    code, out, line = command(*arguments, *small[:2])
    assert (code, out) == (2, "")
    assert words in line
    assert line.count("\n") == 1


def test_interruption_leaves_no_traceback(small, blade_file, monkeypatch, command):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("bladerub.contact.run.simulate", interrupted)
    assert command(*RUN, *small) == (130, "", "bladerub run: interrupted\n")


def test_a_blade_that_is_damaged_or_of_another_config_is_named_and_made_anew_when_deleted(
    small, blade_file, folder, command
):
    config = folder / "longer.yaml"
    config.write_text("blade: {length: 0.4}\n")
    code, _, line = command(*RUN, *small, "--config", str(config))
    assert code == 2
    assert line.startswith(f"bladerub run: {blade_file}: was built from another config; ")
    path = blade_file.with_name("mesh.h5")
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    code, _, line = command(*RUN, *small)
    assert (code, line.count("\n")) == (2, 1)
    assert line.startswith(f"bladerub run: {path}: not a readable HDF5 file")
    path.unlink()
    assert main([*RUN, *small]) == 0
    assert path.read_bytes() == whole


def test_a_reader_that_ends_early_is_no_error(tmp_path):
    overlay = tmp_path / "nowhere.yaml"
    overlay.write_text("results: nowhere\n")
    program = "import sys; from bladerub.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "status", "--config", str(overlay)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait() == 0


def test_every_text_can_be_printed_in_any_locale(monkeypatch):
    text = "θ = 0.15, 10 µm, M\udcfcller.inp"  # a name of other bytes
    stream = io.TextIOWrapper(io.BytesIO(), "ascii")
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setattr("bladerub.cli.status.status", lambda options: print(text))
    assert main(["status"]) == 0
    assert stream.buffer.getvalue() == f"{text}\n".encode("utf-8", "surrogateescape")
