"""The stress of a run, from its sampled motion and the stress of the blade by it; table of the peaks."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import mode_shapes_at
from bladerub.contact.result import RunResult
from bladerub.contact.spec import RunSpec
from bladerub.extras.stress.nodal import NodalStress, running_displacement
from bladerub.extras.stress.peak import ModalStress, static_peak, stress_peaks, stressed_nodes
from bladerub.extras.stress.sampling import SampledRun, simulate_sampled
from bladerub.io import hdf5
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Material
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.solver import Solver
from bladerub.study.variants import filled, with_variant

INSTANTS = 200  # a revolution; ten times as many raise the largest von Mises stress by up to 2 %
# for many runs, stress is kept where the rotation or one of so many modes causes this share of its most
_MODES, _SHARE = 3, 0.7

_CASE = ("casing", "E", "K", "theta", "law")
_PEAK = ("order", "f_peak", "amplitude")
_OF_LAST = ("von_mises", "von_mises_x", "von_mises_y", "von_mises_z", "principal", "alternating")
_BEFORE = ("status", "rotation_von_mises", "start_up_von_mises")
COLUMNS = [*_CASE, *_PEAK, *_BEFORE, *(f"last_{name}" for name in _OF_LAST)]
"""Columns of ``stress.csv``, described in ``columns.csv``."""


@dataclass(frozen=True)
class RunStress:
    """Largest stress of a run, Pa, with place at rest (m) and time (revolutions)."""

    static: dict[str, float]  # of the rotation alone, as of `bladerub.extras.stress.peak.static_peak`
    start_up: dict[str, float]  # up to `last`, as of `bladerub.extras.stress.peak.stress_peaks`; may be empty
    last: dict[str, float]  # over the last revolutions, likewise

    def attributes(self) -> dict[str, float]:
        """Name each figure for the file of the run, as ``stress_last_von_mises``."""
        parts = vars(self).items()
        return {f"stress_{part}_{name}": value for part, peaks in parts for name, value in peaks.items()}

    @classmethod
    def described(cls, attributes: Mapping[str, Any]) -> "RunStress | None":
        """Read the stress from the `attributes` of the file of a run; None where they have none."""
        prefixes = [f"stress_{field.name}_" for field in fields(cls)]
        static, start_up, last = (
            {name.removeprefix(prefix): x for name, x in attributes.items() if name.startswith(prefix)}
            for prefix in prefixes
        )
        return cls(static, start_up, last) if last else None


def has_elements(path: str | Path) -> bool:
    """Whether the blade of `path`, its ``mesh.h5``, has any: one of matrices alone tells of no stress."""
    return bool(len(hdf5.read(path, {"cells"})[0]["cells"]))


def stress_of(path: str | Path, f_omega: float) -> NodalStress:
    """Return how to find the stress at the speed `f_omega` of the blade of `path`, which has elements."""
    mesh, attributes = hdf5.read(path, {"points", "cells", "f_omega", "static_displacement"})
    material = Material.model_validate(json.loads(attributes["made_from"])["blade"]["material"])
    running = running_displacement(mesh["f_omega"], mesh["static_displacement"], f_omega)
    return NodalStress(mesh["points"], mesh["cells"], material, running)


def modal_stress(path: str | Path, f_omega: float, patterns: np.ndarray | None = None) -> ModalStress:
    """Return the stress by the reduced coordinates, or by others of reduced coordinates `patterns` (k, n)."""
    mesh, _ = hdf5.read(path, {"recovery", "points", "cells", "interface_nodes"})
    displaced = mesh["recovery"] if patterns is None else np.tensordot(patterns, mesh["recovery"], axes=1)
    # without the elements at the interface: that a contact force acts in a point is of the model, and the
    # stress there of the mesh
    touching = np.isin(mesh["cells"], mesh["interface_nodes"]).any(axis=1)
    nodes = np.setdiff1d(mesh["cells"], mesh["cells"][touching])
    return ModalStress.of_mesh(stress_of(path, f_omega), displaced, mesh["points"], nodes)


class BladeStress:
    """Stress of a blade at any speed, for many runs of it.

    It is found for each reduced coordinate at three speeds, and between them as a parabola over the square of
    the speed, at those nodes that one of the first modes or the rotation stresses most. `path` is the
    ``mesh.h5`` of the blade; `BadInput` if that is of matrices alone.
    """

    def __init__(self, path: str | Path, blade: ReducedBlade):
        if not has_elements(path):
            raise BadInput(f"{path}: the blade is of matrices alone, which tell of no stress")
        fastest = float(hdf5.read(path, {"f_omega"})[0]["f_omega"].max())
        self._squares = np.array([0.0, 0.5, 1.0]) * fastest**2
        *slower, highest = np.sqrt(self._squares)
        whole = modal_stress(path, highest)
        nodes = stressed_nodes(whole.of(mode_shapes_at(blade, fastest)[1][:, :_MODES].T), _SHARE)
        self._at = [*(modal_stress(path, speed).at(nodes) for speed in slower), whole.at(nodes)]
        self._blade = blade

    def at(self, f_omega: float) -> ModalStress:
        """Return the stress at the speed `f_omega` as a function of the reduced coordinates."""
        a, b, c = self._squares
        x = f_omega**2
        parts = [
            (x - b) * (x - c) / (a - b) / (a - c),
            (x - a) * (x - c) / (b - a) / (b - c),
            (x - a) * (x - b) / (c - a) / (c - b),
        ]
        static, slope = (
            sum(float(weight) * getattr(stress, name) for weight, stress in zip(parts, self._at, strict=True))
            for name in ("static", "slope")
        )
        return ModalStress(self._at[0].points, static, slope)

    def of_run(self, spec: RunSpec, last: int) -> tuple[RunResult, RunStress | None]:
        """Simulate a run and find its stress, with outcome as of `StressSolver`."""
        run = simulate_sampled(self._blade, spec, INSTANTS)
        return run.result, sampled_stress(self.at(spec.f_omega).of(run.patterns), run, last)


class StressSolver(Solver):
    """Simulates runs of a blade as `Solver`, but for rounding of energies; keeps `stress` of the first.

    `mesh` is the ``mesh.h5`` of the blade, `last` how many revolutions are the last ones. The stress is None
    where the blade is of matrices alone, or no revolution is complete.
    """

    def __init__(self, mesh: str | Path, last: int):
        self._mesh, self._last = mesh, last
        self._is_done = not has_elements(mesh)
        self.stress: RunStress | None = None

    def simulate_longer(self, blade, spec: RunSpec, longer: Callable, progress=None) -> list[RunResult]:
        """Simulate the first run alone, after which its `stress` is there; later ones as `Solver`."""
        if self._is_done:
            return super().simulate_longer(blade, spec, longer, progress)
        self._is_done = True
        run = simulate_sampled(blade, spec, INSTANTS, progress)
        stress = modal_stress(self._mesh, spec.f_omega, run.patterns)
        self.stress = sampled_stress(stress, run, self._last)
        return [run.result]


def sampled_stress(stress: ModalStress, run: SampledRun, last: int) -> RunStress | None:
    """Find the stress of a sampled run, as `StressSolver` does; `stress` is that of its amplitudes."""
    revolutions = np.isfinite(run.result.revolution_amplitude).sum()
    if not revolutions:  # is complete
        return None
    begin, end = np.searchsorted(run.time, (max(revolutions - last, 0), revolutions), side="right")
    parts = [slice(0, begin), slice(begin, end)] if begin else [slice(0, end)]
    *start_up, last_peaks = stress_peaks(stress, run.amplitudes, run.time, parts)
    return RunStress(static_peak(stress), start_up[0] if start_up else {}, last_peaks)


@threadpool_limits.wrap(limits=1, user_api="blas")  # the products are small
def table(mesh: str | Path, blade: ReducedBlade, config: Config, peaks: pd.DataFrame) -> pd.DataFrame:
    """Find the stress at each of the `peaks`: rows of `COLUMNS`, see `with_variant`."""
    stress, rows = BladeStress(mesh, blade), []
    for peak in filled(peaks).dropna(subset=["f_peak"]).to_dict("records"):
        spec = run_spec(config, CoatingCase.described(peak), peak["f_peak"])
        result, run_stress = stress.of_run(spec, config.analysis.spectrum_revolutions)
        rows.append({name: peak[name] for name in (*_CASE, "variant", *_PEAK)} | {"status": result.status})
        if run_stress:
            rows[-1]["rotation_von_mises"] = run_stress.static["von_mises"]
            rows[-1]["start_up_von_mises"] = run_stress.start_up.get("von_mises")
            rows[-1] |= {f"last_{name}": run_stress.last[name] for name in _OF_LAST}
    return with_variant(pd.DataFrame(rows, columns=[*COLUMNS, "variant"]), COLUMNS)
