"""What an edit of a finished study plans is what it computes, and nothing that was finished is lost."""

import pytest
import yaml

TARGET = "results/tables/divergence.csv"
STUDY_RUNS = "*/*.h5"
"""Without the longer runs, which are extra."""


def halve_the_speed_step(config):
    config["speeds"]["step"] /= 2


def remove_an_E(config):
    config["coatings"][1]["E"].pop(0)


@pytest.mark.parametrize("edit", [pytest.param(halve_the_speed_step, marks=pytest.mark.nightly), remove_an_E])
def test_an_edit_computes_what_is_missing_or_stale_and_nothing_else(copied_study, tiny, edit):
    def to_do():
        counts = copied_study.status()
        return counts["missing"] + counts["stale"]

    edit(tiny)
    (copied_study.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))  # which the status reads
    planned, before = to_do(), copied_study.runs(STUDY_RUNS)
    copied_study.build(tiny, TARGET)
    now = copied_study.runs(STUDY_RUNS)
    assert before.keys() <= now.keys()
    assert sum(before.get(name) != stamp for name, stamp in now.items()) == planned
    assert (planned == 0) == (edit is remove_an_E)
    assert any(now[name] == stamp for name, stamp in before.items())
    assert copied_study.plan(tiny, TARGET) == {}
    assert to_do() == 0
