import pandas as pd
import pytest

from bladerub.extras.cost.figure import cost
from bladerub.extras.cost.jobs import COLUMNS, table

RECORD = (
    "s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time\n"
    "{s}\t0:00:01\t{memory}\t1\t1\t1\t0\t0\t99\t{cpu}\n"
)


@pytest.fixture
def benchmarks(tmp_path):
    for name, s, memory, cpu in (
        ("blade.tsv", 20.0, 480.0, 15.0),
        ("coating/2nd_E1.1_K0.5_theta0.tsv", 10.0, 190.0, 9.0),
        ("coating/2nd_E2_K0.5_theta0.15.tsv", 30.0, 200.0, 21.0),
        ("fig08_spectrum_soft.tsv", 2.0, 250.0, 1.5),
        ("fig05_casing.tsv", 0.1, "-", "-"),
        ("somebody_elses.tsv", 99.0, 99.0, 99.0),
    ):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(RECORD.format(s=s, memory=memory, cpu=cpu))
    return tmp_path


def test_a_row_a_job(benchmarks):
    costs = table(benchmarks).set_index(["rule", "job"])
    assert {*costs.index.names, *costs.columns} == {*COLUMNS}
    rub = costs.loc[("coating", "2nd_E2_K0.5_theta0.15")]
    assert (rub.stage, rub.wall_s, rub.cpu_s, rub.memory_mb) == ("rubs", 30.0, 21.0, 200.0)
    assert costs.loc[("blade", ""), "stage"] == "blade"
    assert len(costs) == 5
    assert "somebody_elses" in set(table(benchmarks, ["somebody_elses"]).stage)


def test_a_record_that_breaks_off_is_left_out(benchmarks):
    (benchmarks / "blade.tsv").write_text("s\th:m:s\tmax")
    assert sorted(table(benchmarks).rule) == ["coating", "coating", "fig05_casing", "fig08_spectrum_soft"]


def test_bars_are_minutes_and_megabytes():
    stages = pd.DataFrame(
        {"jobs": [1, 57], "cpu_s": [60.0, 540.0], "share": [0.1, 0.9], "memory_mb": [480.0, 190.0]},
        index=pd.Index(["blade", "rubs"], name="stage"),
    )
    time, memory = cost(stages).axes
    assert [bar.get_width() for bar in time.patches] == [1.0, 9.0]
    assert [bar.get_width() for bar in memory.patches] == [480.0, 190.0]
