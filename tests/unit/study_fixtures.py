from dataclasses import replace

import numpy as np
import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.config.read import read, vary
from bladerub.contact.result import Energy, RunResult
from bladerub.io.folders import ROOT
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed
from bladerub.study import store
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.job import compute_missing
from bladerub.study.maps import CoatingMap
from bladerub.study.plan import coating_plan

N_ELEMENTS = 2000
CONFIG = read(ROOT / "config" / "config.yaml")


def changed(config, **sections):
    """Lay sections over those of a config."""
    return typed(vary(config, Located.of(sections, UNKNOWN)).plain())


@pytest.fixture
def config():
    return CONFIG


@pytest.fixture
def case():
    return CoatingCase("2nd", 2.0, 0.5, 0.15)


@pytest.fixture
def spec(config, case):
    return run_spec(config, case, 0.19)


@pytest.fixture
def angle():
    return (np.arange(N_ELEMENTS) + 0.5) * (2 * np.pi / N_ELEMENTS)


@pytest.fixture
def blade(blade):
    """24 uncoupled masses at the tip; C1² = 1 + 3 f_omega² at f1 = 192 Hz, the highest at 940 Hz."""
    k = np.diag((2 * np.pi * 192.0) ** 2 * np.arange(1.0, 25.0))
    return replace(blade, mass=np.eye(24), stiffness_0=k, stiffness_1=3 * k, stiffness_2=0 * k)


@pytest.fixture
def make_result(angle):
    """A run that vibrates at one engine order, wears as many lobes and ends after `complete` revolutions."""

    def make(revolutions=20, order=6.0, amplitude=1e-3, growth=0.0, complete=None, depth=2e-4):
        time = (np.arange(revolutions * N_ELEMENTS) + 0.5) / N_ELEMENTS  # in revolutions
        displacement = amplitude * (1 + growth) ** np.floor(time) * np.sin(2 * np.pi * order * time)
        end = time.size if complete is None else int(complete * N_ELEMENTS)
        displacement[end:] = np.nan
        peak, half_range = np.full((2, revolutions), np.nan)
        begun = int(np.ceil(end / N_ELEMENTS))
        each = displacement.reshape(revolutions, -1)[:begun]
        peak[:begun] = np.nanmax(np.abs(each), axis=1)
        half_range[:begun] = (np.nanmax(each, axis=1) - np.nanmin(each, axis=1)) / 2
        lobe = np.clip(np.cos(order * angle), 0, None)
        told = {"status": "completed" if complete is None else "unbounded", "message": "for a test"}
        worn = {"angle": angle, "wear": depth * np.linspace(1, 0.5, 8)[:, None] * lobe}
        motion = {"radial_displacement": displacement, "revolution_peak": peak}
        motion |= {"revolution_amplitude": half_range, "time_step": 2e-7, "slowest_sliding": 0.9}
        counts = dict.fromkeys(("n_reversed_steps", "n_fallback_steps", "n_unconverged_steps"), 0)
        counts |= {"n_steps": 1000, "n_contact_steps": 300, "n_modes": 24}
        return RunResult(**told, **worn, **motion, **counts, energy=Energy(*np.arange(1.0, 14.0)))

    return make


@pytest.fixture
def make_map(angle):
    """A map whose response on each given order is a hat over speed; C1² = 1 + 3 f_omega²."""

    def make(
        case, peaks, f_omega=None, lobes=6, growth=0.0, status="completed", background=1e-7, longer=None
    ):
        f_omega = np.round(np.arange(0.02, 0.4001, 0.01), 6) if f_omega is None else np.asarray(f_omega)
        n = f_omega.size
        order = np.arange(241) / 10
        amplitude = np.full((n, order.size), background)
        for k, (f_peak, height) in peaks.items():
            hat = height * np.clip(1 - np.abs(f_omega - f_peak) / 0.025, 0, None)
            amplitude[:, round(10 * k)] = np.maximum(background, hat)
        response = amplitude.max(axis=1)
        envelope = response[:, None] * (1 + np.broadcast_to(growth, n)[:, None]) ** np.arange(20)
        lobes = np.broadcast_to(lobes, n).copy()
        wear = 1e-4 * (1 + np.cos(lobes[:, None] * angle)).astype(np.float32)
        worn = {"angle": angle, "wear": wear, "wear_node": np.repeat(wear[:, None], 8, axis=1)}
        worn |= {"max_wear": 0.5 * response, "lobes": lobes}
        motion = {"spectrum_order": order, "spectrum_amplitude": amplitude}
        motion |= {"revolution_peak": envelope + 1e-3, "revolution_amplitude": envelope}
        motion["confirmation_amplitude"] = np.empty((n, 0)) if longer is None else longer
        status = np.broadcast_to(status, n).astype(str)
        return CoatingMap(case, f_omega, np.sqrt(1 + 3 * f_omega**2), **worn, **motion, status=status)

    return make


@pytest.fixture
def growing():
    """Growth of the simulated runs by speed, none where there is no entry."""
    return {}


@pytest.fixture
def repeated():
    return []


@pytest.fixture
def solve_by(monkeypatch):
    """Put a stand-in, ``simulate(spec)``, in the place of the solver."""

    def patch(simulate):
        def simulate_longer(blade, spec, longer, progress=None):
            results = [simulate(spec)]
            if revolutions := longer(results[0]):
                results.append(simulate(replace(spec, revolutions=revolutions)))
            return results

        monkeypatch.setattr("bladerub.contact.run.simulate_longer", simulate_longer)

    return patch


@pytest.fixture
def simulated(solve_by, make_result, growing, repeated):
    """Stand in for the solver, and list the speeds it was asked for."""
    speeds = []

    def simulate(spec):
        (speeds if spec.revolutions == 20 else repeated).append(spec.f_omega)
        return make_result(
            revolutions=spec.revolutions,
            growth=growing.get(spec.f_omega, 0.0),
            complete=1.5 if spec.f_omega == 0.3 else None,
        )

    solve_by(simulate)
    return speeds


@pytest.fixture
def write_run(tmp_path, spec, case, config, make_result):
    def write(name="0.1900.h5", key="key", result=None, history=False, spec=spec, case=case, **made):
        result = result or make_result(**made)
        stored = store.stored_run(case, spec, result, key, config.analysis, history)
        store.write_run(tmp_path / name, stored, provenance(config.plain()))
        return tmp_path / name

    return write


@pytest.fixture
def study(config):
    return changed(config, speeds={"start": 0.1, "stop": 0.3, "step": 0.1, "extra": [0.19]})


@pytest.fixture
def compute(study, case, tmp_path):
    def run(digest="blade", study=study, **arguments):
        return compute_missing(study, coating_plan(study, case), None, tmp_path, digest, **arguments)

    return run
