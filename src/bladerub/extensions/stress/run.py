"""The stress of a run: it is computed again with its motion recorded, and the run itself stays as it is."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bladerub.blade.elasticity import Material
from bladerub.blade.model import ReducedBlade
from bladerub.blade.stress import NodalStress, running_displacement
from bladerub.contact.recording import record
from bladerub.contact.row_spec import Row
from bladerub.contact.spec import RunSpec
from bladerub.extensions.stress.peak import ModalStress, static_peak, stress_peak
from bladerub.io import hdf5

INSTANTS = 200
"""A revolution; ten times as many raise the largest stress by up to 2 %."""


@dataclass(frozen=True)
class RunStress:
    """Largest stress of a run, Pa, with place at rest (m) and time (revolutions).

    Parameters
    ----------
    static : dict
        Of the rotation alone, as of `bladerub.extensions.stress.peak.static_peak`.
    start_up : dict
        From the start to where `last` begins, as of `bladerub.extensions.stress.peak.stress_peak`; empty
        where the run has no more revolutions than those.
    last : dict
        Over the last revolutions, likewise.
    """

    static: dict[str, float]
    start_up: dict[str, float]
    last: dict[str, float]


def stress_of(path: str | Path, f_omega: float) -> NodalStress | None:
    """Return how to find the stress at the speed `f_omega` of the blade in `path`, its ``mesh.h5``.

    None where the blade is of matrices alone: they tell of no stress.
    """
    mesh, attributes = hdf5.read(path)
    if not len(mesh["cells"]):
        return None
    material = Material.from_config(json.loads(attributes["made_from"])["blade"]["material"])
    running = running_displacement(mesh["f_omega"], mesh["static_displacement"], f_omega)
    return NodalStress(mesh["points"], mesh["cells"], material, running)


def complete_revolutions(revolution_peak: np.ndarray, status: str) -> int:
    """Count the revolutions that a run of this outcome has completed; `revolution_peak` as of `RunResult`."""
    return int(np.isfinite(revolution_peak).sum()) - (status == "unbounded")


def run_stress(
    mesh: str | Path,
    blade: ReducedBlade,
    spec: RunSpec,
    last: int,
    revolutions: int | None = None,
    progress: Callable[[int], None] | None = None,
    instants: int = INSTANTS,
) -> RunStress | None:
    """Find the stress of a run of a single blade.

    Parameters
    ----------
    mesh : path
        The ``mesh.h5`` of the blade.
    blade : ReducedBlade
        The blade.
    spec : RunSpec
        The run.
    last : int
        How many revolutions are the last ones.
    revolutions : int, optional
        Those that the run completes; default: all of `spec`. A run that ends as unbounded has fewer.
    progress : callable, optional
        Called with the number of revolutions done after each of them.
    instants : int
        Instants per revolution that are looked at.

    Returns
    -------
    RunStress or None
        None where the blade is of matrices alone, which tell of no stress, or no revolution is complete.
    """
    at_speed = stress_of(mesh, spec.f_omega)
    revolutions = spec.revolutions if revolutions is None else revolutions
    if at_speed is None or not revolutions:
        return None
    data, _ = hdf5.read(mesh, {"recovery", "points"})
    stress = ModalStress(at_speed, data["recovery"], data["points"])
    n_elements = spec.coating.n_elements
    count = revolutions * min(instants, n_elements)
    elements = np.rint(np.linspace(0, revolutions * n_elements, count + 1)[1:]).astype(int)
    motion = record(blade, spec, Row.even(1), elements.tolist(), progress)
    coordinates = motion.coordinates[:, 0]
    is_last = motion.time > revolutions - last

    def peak(chosen: np.ndarray) -> dict[str, float]:
        return stress_peak(stress, coordinates[chosen], motion.time[chosen]) if chosen.any() else {}

    return RunStress(static_peak(stress), peak(~is_last), peak(is_last))
