import numpy as np
import pytest

from bladerub.config import read as configuration
from bladerub.extras.benchmark import gpu
from bladerub.extras.benchmark.gpu import Measures, agreement
from bladerub.extras.gpu import emulation
from bladerub.io import tables

SMALL = {
    "contact": {"elements": 200},
    "coatings": [
        {"casing": "2nd", "E": [2], "K": [0.5, 5], "theta": [0.0]},
        {"casing": "2nd", "coating": "rigid", "friction": [0.0]},
    ],
    "speeds": {"start": 0.2, "stop": 0.3, "step": 0.1, "extra": []},
    "solver": {"revolutions": 3, "steps_per_element": 20, "max_time_step": 1e-5},
    "analysis": {
        "spectrum_revolutions": 2,
        "divergence": {"revolutions": 3, "confirmation_revolutions": 6},
        "histories": [],
    },
}


def measured(status="completed", n_steps=10, peak=(1.0, 2.0)):
    return Measures(status, n_steps, 5, np.array(peak), 1e-5)


def test_differences_are_counted_and_the_largest_revolution_of_a_run_taken():
    same = (measured(), measured())
    other = (measured(peak=(1.0, 2.02)), measured(status="unbounded", n_steps=9, peak=(1.01, 2.0)))
    told = agreement([same] * 3 + [other])
    assert (told["same_status"], told["same_steps"], told["same_contact_steps"]) == (3, 3, 4)
    assert told["peak_error_median"] == 0
    assert told["peak_error_largest"] == pytest.approx(0.01)
    assert told["largest_residual"] == 1e-5


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
def test_the_study_on_an_emulated_gpu(blade, tmp_path):
    study = configuration.read("config/config.yaml", command_line=SMALL)

    def device(works, watch):
        for left in emulation.run(works):
            watch(2.0)
            yield left

    figures = gpu.compare(blade, study, device, 3)
    assert (figures["gpu_runs"], figures["compared_runs"], figures["handed_over"]) == (4, 3, 0)
    assert figures["same_status"] == figures["same_steps"] == 3
    assert figures["peak_error_median"] < 1e-6
    assert figures["peak_error_largest"] < 1e-2  # of a run whose rounding grows
    assert figures["kernel_s"] > 0
    assert figures["gpu_s"] > 0
    row = gpu.row("emulated", figures)
    tables.write(tmp_path / "gpu.csv", row, {})
    assert tables.read(tmp_path / "gpu.csv", gpu.COLUMNS).gpu.item() == "emulated"
