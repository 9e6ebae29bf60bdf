"""What an edit of a finished study plans is what it computes, and nothing that was finished is lost."""

import pytest
from edits import EDITS, outcome

TARGET = "results/tables/divergence.csv"
SAMPLE = ("halve the speed step", "remove an E")  # for the others: test_dag


@pytest.mark.parametrize("edit", [edit for edit in EDITS if edit.name in SAMPLE], ids=lambda edit: edit.name)
def test_an_edit_computes_what_is_missing_or_stale_and_nothing_else(copied_study, tiny, edit):
    found = outcome(copied_study, tiny, edit, TARGET)
    assert found.computed == found.planned
    assert found.lost == found.left == 0
    assert found.kept > 0
    assert (found.computed == 0) == (edit.name == "remove an E")
