"""Numbers beside reference numbers with their uncertainty."""

import pandas as pd
import pytest

from bladerub.extras.verification.compare import compare

KNOWN = pd.DataFrame(
    {"number": ["f1", "f2", "share"], "value": [100.0, 200.0, 0.25], "unit": ["Hz", "Hz", "1"]}
).assign(uncertainty=[0.5, 1.0, 0.0])


@pytest.fixture
def folders(tmp_path):
    """Write the reference, and a table to compare; return both folders."""

    def written(table, name="blade"):
        for folder, content, file in (("reference", KNOWN, "blade"), ("own", table, name)):
            (tmp_path / folder).mkdir()
            content.to_csv(tmp_path / folder / f"{file}.csv", index=False)
        return tmp_path / "own", tmp_path / "reference"

    return written


@pytest.mark.parametrize(("f1", "agrees"), [(100.999, True), (99.001, True), (101.001, False)])
def test_numbers_agree_within_twice_the_uncertainty(folders, f1, agrees):
    table = compare(*folders(KNOWN[["number", "value"]].assign(value=[f1, 200.0, 0.25])))
    assert table.agrees.tolist() == [agrees, True, True]
    assert table.number.tolist() == ["f1", "f2", "share"]
    assert table.allowed[0] == pytest.approx(1.0, rel=1e-3)


def test_the_uncertainty_of_both_counts(folders):
    own = KNOWN.assign(value=[102.2, 200.0, 0.25], uncertainty=[1.2, 0.0, 0.0])
    found = compare(*folders(own))
    assert found.agrees.all()
    assert found.allowed[0] == pytest.approx(2 * 1.3, rel=1e-3)
