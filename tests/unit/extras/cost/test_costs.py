import re

import pytest
from study_fixtures import changed

from bladerub.extras import inventory
from bladerub.extras.cores import Costs, costs_of
from bladerub.extras.cost.forecast import forecast
from bladerub.extras.cost.jobs import COLUMNS, table

RECORD = (
    "s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time\n"
    "{s}\t0:00:01\t{memory}\t1\t1\t1\t0\t0\t99\t{cpu}\n"
)


def test_a_row_a_job(tmp_path):
    (tmp_path / "coating").mkdir()
    for name, s, memory, cpu in (
        ("blade.tsv", 20.0, 480.0, 15.0),
        ("coating/2nd_E1.1_K0.5_theta0.tsv", 10.0, 190.0, 9.0),
        ("coating/2nd_E2_K0.5_theta0.15.tsv", 30.0, 200.0, 21.0),
        ("fig08_spectrum_soft.tsv", 2.0, 250.0, 1.5),
        ("fig05_casing.tsv", 0.1, "-", "-"),
        ("somebody_elses.tsv", 99.0, 99.0, 99.0),
    ):
        (tmp_path / name).write_text(RECORD.format(s=s, memory=memory, cpu=cpu))
    costs = table(tmp_path).set_index(["rule", "job"])
    assert {*costs.index.names, *costs.columns} == {*COLUMNS}
    rub = costs.loc[("coating", "2nd_E2_K0.5_theta0.15")]
    assert (rub.stage, rub.wall_s, rub.cpu_s, rub.memory_mb) == ("rubs", 30.0, 21.0, 200.0)
    assert costs.loc[("blade", ""), "stage"] == "blade"
    assert len(costs) == 5
    assert "somebody_elses" in set(table(tmp_path, ["somebody_elses"]).stage)
    (tmp_path / "blade.tsv").write_text("s\th:m:s\tmax")
    assert sorted(table(tmp_path).rule) == ["coating", "coating", "fig05_casing", "fig08_spectrum_soft"]


JOBS = [(rule, f"2nd_E{E}_K0.5_theta0") for E in (1, 2) for rule in ("coating", "map", "ensemble")]


def test_a_dry_run_counts_what_is_left_and_what_its_jobs_cost(config, monkeypatch, tmp_path):
    """Of a study of which forty of a hundred runs of each coating are done."""
    counts = dict.fromkeys(inventory.COUNTS, 0) | {"planned": 100, "done": 40}
    monkeypatch.setattr(inventory, "take", lambda *_: (counts, []))
    monkeypatch.setattr(inventory, "current_blade", lambda *_: (None, None))
    study = changed(config, coatings=[{"casing": "2nd", "E": [1, 2], "K": [0.5], "theta": [0.0]}])
    study = study.replaced("results", str(tmp_path)).replaced("solver.revolutions", 3600)
    study = study.replaced("analysis.divergence.confirmation_revolutions", 7200)
    jobs = [("blade", None), *JOBS, ("fig11_Y4", None)]
    line = forecast(study, jobs)
    *numbers, minutes = re.findall(r"\d+", line.replace(",", ""))
    assert numbers == ["120", "200", "8"]
    longer = forecast(study.replaced("solver.revolutions", 7200), jobs).replace(",", "")
    assert int(re.findall(r"\d+", longer)[-1]) > 1.3 * int(minutes) > 10
    assert costs_of(study).further["ensemble"][JOBS[0][1]] > 0
    assert forecast(study, JOBS[:1]).startswith("60 of 200 runs of the study are to be computed; 1 job, ")
    assert "those of 1 coating beside it" in forecast(study, [("coating", "2nd_E3_K0.5_theta0")])
    chart = forecast(study, [("chart_column", None)], simulating={"chart_column", "coating"})
    assert chart.startswith("120 of 200 runs of the study are missing, and not")
    members = tmp_path / "runs" / JOBS[0][1] / "ensemble" / "manifest.tsv"
    members.parent.mkdir(parents=True)
    members.touch()
    assert forecast(study, jobs) == line
    beside = tmp_path / "runs" / "2nd_E3_K0.5_theta0" / "ensemble" / "manifest.tsv"
    beside.parent.mkdir(parents=True)
    beside.touch()  # of a coating that the study does not have
    assert "1 job, about 1 min" in forecast(study, [("ensemble", "2nd_E3_K0.5_theta0")])
    counts["done"] = 100
    assert "2 jobs, about 1 min" in forecast(study, [JOBS[0], JOBS[2]])


@pytest.mark.parametrize(
    ("cost", "cores", "threads"), [(1, 16, 1), (1, 64, 5), (10, 4, 3), (100, 4, 4), (10, None, 1)]
)
def test_a_job_larger_than_the_share_of_a_core_has_more_threads(cost, cores, threads):
    costs = Costs({"this": cost}, {"others": {"that": 100 - cost}})
    assert costs.threads("coating", "this", cores) == threads
