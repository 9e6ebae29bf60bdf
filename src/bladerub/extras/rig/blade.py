"""A rub rig: a blade tip, rigid or of an elastic blade, that is fed into a coated disk.

An elastic blade passes over a coated sample by the time loop:

1. The blade is fed while it is far from the sample, by moving the sample: at pass p its surface stands p
   incursions above the tip of the blade at its running position. All nodes are fed alike.
2. The profile of the tip spans `ELEMENTS` elements under each node, as long together as the tip of the rig.
3. Forces are taken at the end of the passage of each element, and summed over the nodes.
4. By θ the force turns against the motion as in the time loop; the tangential force also has what the coating
   takes up by wear, over the coated length, as with a rigid tip (`bladerub.extras.rig.passes`).
"""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.api.arguments import InputError, over
from bladerub.api.blade import Blade
from bladerub.api.planned import checked_number
from bladerub.api.study import default_study
from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
from bladerub.contact.spec import Casing, RunSpec, TipProfile
from bladerub.contact.start import SEARCH_RANGE, minimum_gap
from bladerub.contact.strips import by_angle, strip_width
from bladerub.extras.rig.passes import COLUMNS as RIGID_COLUMNS
from bladerub.extras.rig.passes import simulate_passes
from bladerub.extras.rig.spec import Rig
from bladerub.numerics.memory import aligned

ELEMENTS, STEPS = 16, 12  # under the tip of a node, and least number of time steps in the passage of one
COLUMNS = (*RIGID_COLUMNS, "largest_normal_force", "radial_amplitude")  # of `simulate_blade_passes`
_LONGEST_STEP = 2e-6  # s
_LIMIT = 0.1  # displacement, lengths of the blade
_FAR = 1.0  # gap over what has no coating, m
_MARGIN = 4 * SEARCH_RANGE  # elements before and behind the sample in which forces are looked for
_FED = 0.1  # share of the track at least that must be free


@over("rig")
def simulate_rig(
    rig: Rig, blade: Blade | None = None, damping_ratio: float | None = None, disk_turns: bool = False
) -> pd.DataFrame:
    """Simulate the passes of a rub rig.

    Parameters
    ----------
    rig : Rig
        Tip, coated disk and incursion; a list of rigs gives a list of tables.
    blade : Blade, optional
        An elastic blade in the place of the rigid tip. Width of the tip and length of the track are then its
        own, and the coated part of the track must leave room to feed it.
    damping_ratio : float, optional
        Damping of its modes; that of the default study if not given.
    disk_turns : bool
        Whether the disk turns instead of the blade, which then has its stiffness at rest.

    Returns
    -------
    DataFrame
        A row for each pass, SI units: see ``results/tables/rigs.csv`` in the reference of the tables. With a
        blade also ``largest_normal_force`` (N) and ``radial_amplitude`` of node 1 (m); forces are then means
        over the time that the coated part takes.

    Raises
    ------
    ValueError
        If a parameter of the law is out of its range, or the blade cannot be simulated in this rig: the
        message names the parameter, its value and what is right.

    Examples
    --------
    >>> import bladerub as br
    >>> rig = br.Rig(
    ...     "mine", E=600e6, K=300e6, yield_stress=0.0, thickness=3e-3, tip_width=1e-2, tip_length=2e-3,
    ...     track=1.0, speed=125.0, incursion=1e-5, passes=3, coated=0.05,
    ... )
    >>> passes = br.simulate_rig(rig)
    >>> (passes.worn_depth * 1e6).round(2).tolist()  # µm
    [6.67, 13.33, 20.0]

    An elastic blade yields in the first pass, and still vibrates when the next begins:

    >>> elastic = br.simulate_rig(rig, blade)
    >>> bool(elastic.worn_depth[0] < passes.worn_depth[0]), bool(elastic.energy_residual.max() < 1e-3)
    (True, True)
    """
    if not isinstance(rig, Rig):
        raise InputError("rig", rig, "must be a Rig")
    if blade is None:
        return simulate_passes(rig)
    if not isinstance(blade, Blade):
        raise InputError("blade", blade, "must be a Blade")
    config = default_study().config
    if damping_ratio is None:
        damping_ratio = config.contact.damping_ratio
    damping_ratio = checked_number(config, "damping_ratio", damping_ratio)
    return simulate_blade_passes(rig, blade.reduced, damping_ratio, disk_turns)


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_blade_passes(
    rig: Rig, blade: ReducedBlade, damping_ratio: float, disk_turns: bool = False, elements: int = ELEMENTS
) -> pd.DataFrame:
    """Simulate the passes of a rig whose tip is that of an elastic blade; a row each, with `COLUMNS`.

    There are so many `elements` of the coating under the tip of a node. ``normal_force`` and
    ``tangential_force`` are means: the impulses over the time that the coated length takes. ``worn_depth``
    and ``temperature_rise`` are means over the sample, ``largest_pressure`` is that of a node on the area
    under its tip, ``radial_amplitude`` half the range of node 1 in the pass (m). Raises `ValueError` if the
    sample leaves no room to feed the blade, the blade is not defined at this speed, its tip leaves the
    displacement limit, a tenth of its length, or a parameter of the law is out of its range.
    """
    rig = replace(rig, track=2 * math.pi * blade.tip_radius, tip_width=float(strip_width(blade).sum()))
    f_omega = rig.speed / rig.track / blade.f1_hz
    if disk_turns:
        none, fastest = 0.0 * blade.stiffness_1, max(f_omega, blade.f_omega_max)
        blade = replace(blade, stiffness_1=none, stiffness_2=none, stiffness_higher=(), f_omega_max=fastest)
    elif f_omega > blade.f_omega_max:
        fastest = blade.f_omega_max * blade.f1_hz * rig.track
        raise ValueError(f"speed = {rig.speed:g}: must be at most {fastest:g}, the fastest of this blade")
    spec = RunSpec(
        casing=Casing("rig", (1,), (1.0,), 1.0, 1.0, 0.0),  # the sample takes its place
        coating=replace(rig.coating, n_elements=round(elements * rig.track / rig.tip_length)),
        tip=TipProfile(elements / 2, rig.edge_drop),
        clearance=(0.0, 0.0),
        damping_ratio=damping_ratio,
        f_omega=f_omega,
        revolutions=1,
        scheme="exponential",
        steps_per_element=STEPS,
        max_time_step=_LONGEST_STEP,
        displacement_limit=_LIMIT * blade.length,
    )
    rule, simulation = set_up(blade, spec)
    sample = _Sample(rig, blade, spec, simulation)
    passes, worn, taken = [], 0.0, 0.0
    for number in range(1, rig.passes + 1):
        depth, rise = number * rig.incursion, sample.rise()
        sample.stand(depth)
        impulse, largest, largest_pressure, amplitude = sample.one_pass(rule)
        balance = energy.balance(rule, simulation.state, 0.0, simulation.angle_per_step)
        normal = math.cos(rig.theta) * impulse
        tangential = math.sin(rig.theta) * impulse + (balance.wear - taken) / rig.speed
        per_time = rig.speed / sample.length
        wear = sample.mean(simulation.state.wear)
        forces = (normal * per_time, tangential * per_time, normal, tangential, largest_pressure)
        losses = (wear, wear - worn, balance.wear - taken, rise, balance.residual)
        passes.append((number, depth, *forces, *losses, math.cos(rig.theta) * largest, amplitude))
        worn, taken = wear, balance.wear
    return pd.DataFrame(passes, columns=list(COLUMNS))


class _Sample:
    """The coated part of the track, opposite to where the blade stands at the start of a revolution."""

    def __init__(self, rig: Rig, blade: ReducedBlade, spec: RunSpec, simulation: Simulation):
        self._blade, self._spec = blade, spec
        n_elements, n_nodes = spec.coating.n_elements, blade.n_interface
        stator = simulation.stator
        lanes = stator.initial_gap.shape[1]
        rows = np.tile(np.arange(n_elements)[:, None], (1, lanes))
        row_of = by_angle(blade, spec, rows)  # (j, N): the row of each element under each node
        length = rig.coated or rig.track
        count = round(length / rig.track * n_elements)
        centre = int(np.argmin(abs(row_of[0] - n_elements // 2)))
        self._coated = (centre - count // 2 + np.arange(count)) % n_elements
        self._rows = row_of[:, self._coated]  # (j, c)
        self._first, self._last = int(self._rows.min()) - _MARGIN, int(self._rows.max()) + 1 + _MARGIN
        if count > (1 - _FED) * n_elements or self._first < 0 or self._last > n_elements:
            chord = float(np.ptp(row_of[:, centre])) * rig.track / n_elements
            free = (1 - _FED) * rig.track - chord
            limits = f"must be above 0 and at most {free:.3g}, to feed the blade where there is no coating"
            raise ValueError(f"coated = {rig.coated:g}: {limits}")
        self.length = count * rig.track / n_elements
        self._area = strip_width(blade) * rig.tip_length
        gap = np.full((n_elements, lanes), _FAR)
        still: Any = aligned(stator._replace(initial_gap=gap, minimum_gap=gap[:, 0].copy()))
        self._simulation = type(simulation)(
            *(simulation.modal, simulation.flight, still, simulation.tip, simulation.state),
            *(simulation.steps_per_element, simulation.layer),
        )
        self._nodes = np.arange(n_nodes)[:, None]

    def stand(self, depth: float) -> None:
        """Let the original surface of the sample stand by `depth` (m) above the tip at rest."""
        stator = self._simulation.stator
        stator.initial_gap[self._rows, self._nodes] = -depth
        gaps = stator.initial_gap[:, : len(self._nodes)].T
        stator.minimum_gap[:] = minimum_gap(gaps, self._spec.tip.half_width)

    def one_pass(self, rule: Recurrence) -> tuple[float, float, float, float]:
        """Let the blade pass over the sample, and turn on to where it started.

        Returns impulse (N s) and largest value (N) of the contact force of all nodes together, the largest
        pressure of a node (Pa), and half the range of the radial displacement of node 1 (m).
        """
        simulation, n_elements = self._simulation, self._spec.coating.n_elements
        displacement = np.empty(n_elements)
        borders = sorted({0, *range(self._first, self._last + 1), n_elements})
        forces, lowest, highest = [], math.inf, -math.inf
        for first, last in pairwise(borders):
            progress = simulation.advance(displacement[first:last], first)
            if progress.n_steps < (last - first) * simulation.steps_per_element:
                limit = self._spec.displacement_limit
                raise ValueError(f"incursion: the tip of the blade moves by more than {limit:g} m")
            lowest, highest = min(lowest, progress.lowest), max(highest, progress.highest)
            forces.append(simulation.state.normal_force.ravel()[: len(self._nodes)].copy())
        of_nodes = np.array(forces)
        total = of_nodes.sum(axis=1)
        impulse = float(total.sum()) * rule.time_step * simulation.steps_per_element
        pressure = float((of_nodes / self._area).max())
        return impulse, float(total.max()), pressure, 0.5 * (highest - lowest)

    def mean(self, values: np.ndarray) -> float:
        """Mean over the sample of the `values` of its state."""
        return float(by_angle(self._blade, self._spec, values)[:, self._coated].mean())

    def rise(self) -> float:
        """Mean rise of the temperature of the sample, K; NaN if the law knows no heat."""
        layer = self._simulation.layer
        return math.nan if layer is None else self.mean(layer.rise(self._simulation.state))
