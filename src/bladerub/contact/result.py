"""What a run gives, in SI units."""

from dataclasses import dataclass, field
from typing import Annotated, get_type_hints

import numpy as np

UNBALANCED = 1e-3  # residual of the ledger over the work exchanged above which a run is not to be trusted


@dataclass(frozen=True)
class Energy:
    """Energy ledger of the run, J.

    The blade: ``kinetic + elastic − initial + damping = work_radial + work_tangential + work_couple``;
    central differences miss what they damp in contact. Blade and casing:
    ``kinetic + elastic − initial + damping + stored + wear + sliding = work_shape + work_rotation``.
    """

    initial: Annotated[float, "energy of the blade at the start"]
    kinetic: Annotated[float, "kinetic energy of the blade at the end"]
    elastic: Annotated[float, "elastic energy of the blade at the end"]
    damping: Annotated[float, "energy dissipated by modal damping"]
    work_radial: Annotated[float, "work done on the blade by the radial contact forces"]
    work_tangential: Annotated[float, "work done on the blade by the tangential contact forces"]
    work_couple: Annotated[
        float, "work done on the blade by the couples of the contact forces, where the tip turns"
    ]
    stored: Annotated[float, "elastic energy in the coating at the end"]
    wear: Annotated[float, "energy dissipated by plastic shortening of the coating"]
    work_shape: Annotated[
        float, "work of the rotation in moving the tip over the casing shape and onto new elements"
    ]
    work_rotation: Annotated[float, "work of the rotation against the tangential resistance of the coating"]
    sliding: Annotated[float, "energy dissipated by the tangential resistance of the coating"]
    exchanged: Annotated[float, "work exchanged in the contact, whatever its sign"]

    @property
    def residual(self) -> float:
        """What the ledger of blade and casing together misses, over the work exchanged; 0 without contact."""
        supplied = self.work_shape + self.work_rotation
        taken = (
            self.kinetic + self.elastic - self.initial + self.damping + self.stored + self.wear + self.sliding
        )
        return abs(supplied - taken) / self.exchanged if self.exchanged else 0.0


ENERGIES: dict[str, str] = {
    name: kind.__metadata__[0] for name, kind in get_type_hints(Energy, include_extras=True).items()
}
"""What each entry of the ledger is."""


@dataclass(frozen=True)
class Outcome:
    """What a run and a speed sweep have in common, on N elements and j nodes.

    After an early end the displacement of node 1, and what is of it in each revolution, is NaN.
    """

    status: str  # "completed"; "unbounded" when a displacement exceeded the limit; "stopped" before its end
    message: str  # the same in words
    angle: np.ndarray  # (N,), casing angle of the element centres, rad
    wear: np.ndarray  # (j, N), permanent shortening of each element under each node, m
    radial_displacement: np.ndarray  # (revolutions N,), of node 1, mean over the passage of each element, m
    revolution_peak: np.ndarray  # (revolutions,), largest absolute one, m; in free flight that of a parabola
    revolution_amplitude: np.ndarray  # (revolutions,), half its range in each whole one (without its mean), m
    n_steps: int  # time steps, and those of them with contact
    n_contact_steps: int
    energy: Energy
    # (j, N) each, what else the law of the coating leaves in the elements, by name; nothing by the paper's
    layer: dict[str, np.ndarray] = field(default_factory=dict, kw_only=True)


@dataclass(frozen=True)
class RunResult(Outcome):
    """Outcome of one run, with the fields of `Outcome`."""

    time_step: float  # s
    # Steps with contact in which a node that touches did not slide over the casing with the rotation: it slid
    # back or, by Coulomb's law, stuck; without any, both laws of friction give the same run
    n_reversed_steps: int
    # Lowest speed over the casing of a node that touches, over that by the rotation: below 0 it slid back; at
    # most 1, which is also that of a run without contact
    slowest_sliding: float
    # Steps in which Newton's method did not converge, so that the forces were found node by node; always 0
    # for the rigid casing, whose forces are always found so
    n_fallback_steps: int
    n_unconverged_steps: int  # whose forces did not converge: what they leave of imbalance goes into the run
    n_modes: int  # that the scheme resolved; the others were condensed
