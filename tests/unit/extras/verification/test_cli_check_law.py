import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from bladerub.cli import main
from bladerub.config import read
from bladerub.contact import law
from bladerub.extras.verification import element_law
from bladerub.io.folders import BENCHMARKS, base_config

PAPER = Path(law.__file__).read_text(encoding="utf-8")


def test_a_law_is_said_to_be_right_or_told_what_is_wrong(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(element_law, "TIME_STEPS", (1e-6,))
    monkeypatch.setattr(element_law, "compile_kernel", lambda law: None)
    path = tmp_path / "mine.py"
    path.write_text(PAPER, encoding="utf-8")
    assert main(["check-law", str(path)]) == 0
    assert capsys.readouterr().out == "mine: 120 histories, no problem; it compiles with the time loop\n"
    path.write_text(PAPER.replace("0.0), increment", "0.0), -increment"), encoding="utf-8")
    assert main(["check-law", str(path)]) == 1
    assert "- wear is negative (depth " in capsys.readouterr().out


def test_numbers_that_are_off_are_named_and_the_exit_code_is_1(tmp_path, command):
    def own(*changed):
        """Write the reference numbers of Rotor 37 as another program's, some of them 5 % higher."""
        table = pd.read_csv(BENCHMARKS / "rotor37" / "blade.csv")[["number", "value", "unit"]]
        table.loc[table.number.isin(changed), "value"] *= 1.05
        table.to_csv(tmp_path / "blade.csv", index=False)
        return tmp_path

    assert command("compare", own(), BENCHMARKS / "rotor37")[0] == 0
    code, out, _ = command("compare", own("f1_rest"), "rotor37", "--json")
    assert code == 1
    assert [row["number"] for row in json.loads(out)["different"]] == ["f1_rest"]


def test_the_lines_are_accepted_by_the_config(tmp_path, capsys):
    def table(highest):
        """Write a curve of E = 900, K = 60, σ_Y = 9 MPa up to a strain, with noise."""
        strain = np.linspace(highest / 40, highest, 40)
        exact = np.minimum(900 * strain, 9 + 900 * 60 / 960 * (strain - 0.01))
        noisy = exact + np.random.default_rng(1).normal(0, 0.05, strain.size)
        path = tmp_path / "curve.csv"
        lines = ["strain,stress (MPa)", *(f"{a},{b}" for a, b in zip(strain, noisy, strict=True))]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return str(path)

    assert main(["fit-coating", table(0.05)]) == 0
    lines = capsys.readouterr().out.partition("for the config:\n")[2]
    file = tmp_path / "fitted.yaml"
    file.write_text(lines, encoding="utf-8")
    study = read.read(base_config(), file)
    contact, coating = study.contact, study.coatings[0]
    assert coating.E[0] * contact.modulus_unit == pytest.approx(900e6, rel=0.02)
    assert coating.K[0] * contact.modulus_unit == pytest.approx(60e6, rel=0.05)
    assert contact.yield_stress * contact.modulus_unit == pytest.approx(9e6, rel=0.02)
    assert contact.modulus_unit == 600e6
    assert main(["fit-coating", table(0.008)]) == 0
    assert "not determined by these curves: K, yield_stress" in capsys.readouterr().out
