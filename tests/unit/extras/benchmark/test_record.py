"""The table of several machines."""

from bladerub.extras.benchmark.record import MACHINE, replace, rows
from bladerub.io import tables


def figures(processor, ratio):
    loops = {"numpy": 1.0, "numba": 10.0, "production": ratio}
    return {
        "processor": processor,
        "vector_bits": 512,
        "cores": 2,
        "steps_per_second": {loop: {"contact": rate, "free": 2 * rate} for loop, rate in loops.items()},
        "ratio_to_numpy": ratio,
        "ratio_to_numba": ratio / 10,
        "ratio_to_numpy_free": ratio,
        "ratio_to_numba_free": ratio / 10,
        "fraction_of_peak_contact": 0.4,
        "fraction_of_peak_free": 0.6,
        "peak_flops": 6e10,
        "seconds_per_run": 0.1,
        "study_minutes": 20.0,
    }


def test_each_machine_has_a_row_for_contact_and_one_for_free_motion(tmp_path):
    path = tmp_path / "benchmark.csv"
    for processor, ratio in (("A", 300.0), ("B", 100.0), ("A", 400.0)):
        replace(path, rows(figures(processor, ratio)), MACHINE, {})
    table = tables.read(path).set_index(["processor", "motion"])
    assert sorted(table.index) == [("A", "contact"), ("A", "free"), ("B", "contact"), ("B", "free")]
    assert table.ratio_to_numpy["A", "contact"] == 400.0
    assert table.steps_per_second_production["B", "free"] == 200.0
    assert table.fraction_of_peak["B", "free"] == 0.6
