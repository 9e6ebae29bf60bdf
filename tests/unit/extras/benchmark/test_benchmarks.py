from functools import cache

import numba
import numpy as np
import pytest
from contact_in_numpy import element_means

from bladerub.config import read as configuration
from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.contact.spec import PLASTIC
from bladerub.extras.benchmark import estimate, gpu, plain
from bladerub.extras.benchmark.record import GPU_COLUMNS, MACHINE, gpu_row, replace, rows
from bladerub.extras.gpu import emulation
from bladerub.extras.law_reading import described_law
from bladerub.extras.study_runs import study_runs
from bladerub.io import tables

SMALL = {
    "coatings": [{"casing": "2nd", "E": [2, 20], "K": [0.5], "theta": [0.15]}],
    "speeds": {"start": 0.16, "stop": 0.4, "step": 0.06, "extra": []},
    "solver": {"revolutions": 3},
    "ensemble": {"members": 2},
    "analysis": {
        "spectrum_revolutions": 2,
        "divergence": {"revolutions": 3, "confirmation_revolutions": 6},
        "histories": [{"casing": "2nd", "E": 2, "K": 0.5, "theta": 0.15, "f_omega": 0.16}],
    },
}


def test_runs_and_members_cost_what_the_drawn_ones_do(blade, monkeypatch):
    """Runs at 0.16 grow and are near a peak, others take twice as long."""
    study = configuration.read("config/config.yaml", command_line=SMALL)
    costs = {True: (1.0, 3.0, True), False: (2.0, 0.0, False)}
    monkeypatch.setattr(estimate, "_cost", lambda blade, config, folder, run: costs[run.f_omega == 0.16])
    monkeypatch.setattr(estimate, "_start", lambda imported: 0.5)
    monkeypatch.setattr(estimate, "DRAWN", 1000)  # all
    found = estimate.estimate(blade, study, cores=4)
    runs = len(study_runs(study))
    near, members = 2, (2 + 2) * (1 + 3 * 2 + 3 * 2)  # and refined: histories, each peak with its neighbours
    seconds = near * 4.0 + (runs - near) * 2.0 + members * 4.0 + 2 * 3 * 0.5
    assert found["study_minutes"] == pytest.approx(seconds / 4 / 60)
    assert found["seconds_per_run"] == pytest.approx((near * 1.0 + (runs - near) * 2.0) / runs)
    assert (found["runs"], found["members"], found["cores"]) == (runs, members, 4)


def figures(processor, ratio):
    loops = {"numpy": 1.0, "numba": 10.0, "production": ratio}
    ratios = [f"ratio_to_{loop}{motion}" for loop in ("numpy", "numba") for motion in ("", "_free")]
    others = ("vector_bits", "cores", "peak_flops", "seconds_per_run", "study_minutes")
    own = {"processor": processor, "fraction_of_peak_contact": 0.4, "fraction_of_peak_free": 0.6}
    own["steps_per_second"] = {loop: {"contact": rate, "free": 2 * rate} for loop, rate in loops.items()}
    return dict.fromkeys(ratios, ratio) | dict.fromkeys(others, 1) | own


def test_each_machine_has_a_row_for_contact_and_one_for_free_motion(tmp_path):
    path = tmp_path / "benchmark.csv"
    for processor, ratio in (("A", 300.0), ("B", 100.0), ("A", 400.0)):
        replace(path, rows(figures(processor, ratio)), MACHINE, {})
    table = tables.read(path).set_index(["processor", "motion"])
    assert sorted(table.index) == [("A", "contact"), ("A", "free"), ("B", "contact"), ("B", "free")]
    assert table.ratio_to_numpy["A", "contact"] == 400.0
    assert table.steps_per_second_production["B", "free"] == 200.0
    assert table.fraction_of_peak["B", "free"] == 0.6


SMALL_FOR_GPU = SMALL | {
    "contact": {"elements": 200},
    "coatings": [
        {"casing": "2nd", "E": [2], "K": [0.5, 5], "theta": [0.0]},
        {"casing": "2nd", "coating": "rigid", "friction": [0.0]},
    ],
    "speeds": {"start": 0.2, "stop": 0.3, "step": 0.1, "extra": []},
    "solver": {"revolutions": 3, "steps_per_element": 20, "max_time_step": 1e-5},
    "analysis": SMALL["analysis"] | {"histories": []},
}


def test_differences_are_counted_and_the_largest_revolution_of_a_run_taken():
    def measured(status="completed", n_steps=10, peak=(1.0, 2.0)):
        return (status, n_steps, 5, np.array(peak), 1e-5)

    same = (measured(), measured())
    other = (measured(peak=(1.0, 2.02)), measured(status="unbounded", n_steps=9, peak=(1.01, 2.0)))
    told = gpu.agreement([same] * 3 + [other])
    assert (told["same_status"], told["same_steps"], told["same_contact_steps"]) == (3, 3, 4)
    assert (told["peak_error_median"], told["largest_residual"]) == (0, 1e-5)
    assert told["peak_error_largest"] == pytest.approx(0.01)


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.skipif(not emulation.is_possible(), reason="no C++ compiler")
def test_the_study_on_an_emulated_gpu(blade, tmp_path):
    study = configuration.read("config/config.yaml", command_line=SMALL_FOR_GPU)

    def device(works, watch):
        for left in emulation.run(works):
            watch(2.0)
            yield left

    figures = gpu.compare(blade, study, device, 3)
    assert (figures["gpu_runs"], figures["compared_runs"], figures["handed_over"]) == (4, 3, 0)
    assert figures["same_status"] == figures["same_steps"] == 3
    assert figures["peak_error_median"] < 1e-6
    assert figures["peak_error_largest"] < 1e-2  # of a run whose rounding grows
    assert min(figures["kernel_s"], figures["gpu_s"]) > 0
    replace(tmp_path / "gpu.csv", gpu_row({"gpu": "emulated", **figures}), ["gpu"], {})
    assert tables.read(tmp_path / "gpu.csv", GPU_COLUMNS).gpu.item() == "emulated"


@cache
def compiled(law):
    return numba.njit(plain.integrator(law))


VISCOPLASTIC = described_law("viscoplastic", {"viscosity": 1e4})


@pytest.mark.slow
@pytest.mark.parametrize("loop", [plain.integrator, pytest.param(compiled, marks=pytest.mark.nightly)])
@pytest.mark.parametrize(
    ("E", "K", "theta", "law"),
    [
        (2.0, 0.1, 0.15, PLASTIC),
        pytest.param(1.1, 0.5, 0.0, PLASTIC, marks=pytest.mark.nightly),
        pytest.param(1.1, 0.5, 0.0, VISCOPLASTIC, marks=pytest.mark.nightly),
    ],
)
def test_the_same_run(blade, spec, change, loop, E, K, theta, law):
    spec = change(spec, E=E, K=K, theta=theta, revolutions=2, element_law=law)
    result = simulate(blade, spec)
    arguments, displacement = plain.arguments(law, *set_up(blade, spec)), np.zeros(result.n_steps)
    loop(law)(*arguments, displacement)
    per_element = element_means(displacement, result.radial_displacement.size)
    scale = np.abs(per_element).max()
    np.testing.assert_allclose(result.radial_displacement, per_element, rtol=0, atol=1e-7 * scale)
    wear = arguments[4]
    np.testing.assert_allclose(np.sort(result.wear), np.sort(wear.T), rtol=0, atol=1e-6 * wear.max())
