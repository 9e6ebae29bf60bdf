"""Studies whose code is not there are left out, and a line says why."""

from bladerub.workflow.studies import rules_of_studies


def test_a_study_without_its_extra_is_left_out(tmp_path):
    for name, extra in (("one", "cost.jobs"), ("two", "nowhere.table"), ("three", "chart.stress")):
        (tmp_path / "studies" / name / "scripts").mkdir(parents=True)
        (tmp_path / "studies" / name / "rules.smk").write_text(f'files_behind("extras.{extra}")\n')
    script = tmp_path / "studies" / "three" / "scripts" / "three.py"
    script.write_text("from bladerub.extras.lost import table\n")
    complete, notes = rules_of_studies(tmp_path)
    assert [path.parent.name for path in complete] == ["one"]
    assert notes == [
        "without the study three, which needs bladerub.extras.lost",
        "without the study two, which needs bladerub.extras.nowhere",
    ]
