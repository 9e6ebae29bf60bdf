"""The stress of a run, from its sampled motion and the stress of the blade as a function of it."""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

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
from bladerub.study.solver import Solver

INSTANTS = 200
"""A revolution; ten times as many raise the largest von Mises stress by up to 2 %."""
_MODES, _SHARE = 3, 0.7
"""For many runs, stress is kept where the rotation or one of so many modes causes this share of its most."""


@dataclass(frozen=True)
class RunStress:
    """Largest stress of a run, Pa, with place at rest (m) and time (revolutions)."""

    static: dict[str, float]  # of the rotation alone, as of `bladerub.extras.stress.peak.static_peak`
    start_up: dict[str, float]  # up to `last`, as of `bladerub.extras.stress.peak.stress_peaks`; may be empty
    last: dict[str, float]  # over the last revolutions, likewise

    def attributes(self) -> dict[str, float]:
        """Name each figure for the file of the run, as ``stress_last_von_mises``."""
        return {
            f"stress_{part}_{name}": value
            for part, figures in vars(self).items()
            for name, value in figures.items()
        }

    @classmethod
    def described(cls, attributes: Mapping[str, Any]) -> "RunStress | None":
        """Read the stress from the `attributes` of the file of a run; None where they have none."""
        parts = {
            part: {
                name.removeprefix(f"stress_{part}_"): value
                for name, value in attributes.items()
                if name.startswith(f"stress_{part}_")
            }
            for part in (field.name for field in fields(cls))
        }
        return cls(**parts) if parts["last"] else None


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
    """Return the stress, as of `stress_of`, as a function of the reduced coordinates, or of others.

    Each of the others has reduced coordinates `patterns` (k, n). Nodes of elements with an interface node are
    left out: that a contact force acts in a point is of the model, and the stress there of the mesh.
    """
    mesh, _ = hdf5.read(path, {"recovery", "points", "cells", "interface_nodes"})
    displaced = mesh["recovery"] if patterns is None else np.tensordot(patterns, mesh["recovery"], axes=1)
    touching = np.isin(mesh["cells"], mesh["interface_nodes"]).any(axis=1)
    nodes = np.setdiff1d(mesh["cells"], mesh["cells"][touching])
    return ModalStress.of_mesh(stress_of(path, f_omega), displaced, mesh["points"], nodes)


class BladeStress:
    """Stress of a blade at any speed, for many runs of it.

    It is found for each reduced coordinate at three speeds, and between them as a parabola over the square of
    the speed. It is kept at those nodes only that one of the first modes or the rotation stresses most.
    `path` is the ``mesh.h5`` of the blade. Raises `BadInput` if that is of matrices alone.
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
    """Simulates runs of a single blade as `Solver`, and keeps the `stress` of the first.

    The run is that of `Solver` but for rounding in the sums of its energies. `mesh` is the ``mesh.h5`` of
    the blade, `last` how many revolutions are the last ones. The stress is None where the blade is of
    matrices alone, which tell of no stress, or no revolution is complete.
    """

    def __init__(self, mesh: str | Path, last: int):
        self._mesh, self._last = mesh, last
        self._is_done = not has_elements(mesh)
        self.stress: RunStress | None = None

    def simulate_longer(
        self,
        blade: ReducedBlade,
        spec: RunSpec,
        longer: Callable[[RunResult], int],
        progress: Callable[[int], None] | None = None,
    ) -> list[RunResult]:
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
