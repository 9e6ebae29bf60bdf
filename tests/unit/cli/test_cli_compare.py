"""``bladerub compare`` as it is called."""

import json

import pandas as pd
import pytest

from bladerub.cli import main
from bladerub.io.folders import BENCHMARKS


@pytest.fixture
def own(tmp_path):
    """Write the reference numbers of Rotor 37 as another program's, some of them 5 % higher."""

    def written(*changed):
        table = pd.read_csv(BENCHMARKS / "rotor37" / "blade.csv")[["number", "value", "unit"]]
        table.loc[table.number.isin(changed), "value"] *= 1.05
        table.to_csv(tmp_path / "blade.csv", index=False)
        return str(tmp_path)

    return written


def test_equal_numbers_agree(own, capsys):
    assert main(["compare", own(), "rotor37"]) == 0
    assert "agree" in capsys.readouterr().out


def test_a_number_that_is_off_is_named_and_the_exit_code_is_1(own, capsys):
    assert main(["compare", own("f1_rest"), str(BENCHMARKS / "rotor37"), "--json"]) == 1
    figures = json.loads(capsys.readouterr().out)
    assert [row["number"] for row in figures["different"]] == ["f1_rest"]
    assert main(["compare", own("f1_rest"), "rotor37"]) == 1
    assert "blade/f1_rest" in capsys.readouterr().out


def test_folders_that_are_not_there_are_refused(own, capsys):
    assert main(["compare", "nowhere", "rotor37"]) == 2
    assert main(["compare", own(), "nowhere"]) == 2
    assert "nowhere" in capsys.readouterr().err
