"""A row of blades that rub on one coating: `RunSpec` and `Row` → `RowResult`.

1. All blades follow the same casing at the same speed, each from its angle on the disk, and pass the elements
   together. The blades share the coating: what one has worn is missing when the next one comes.
2. An element is under one blade at a time: neighbours must stand further apart than the displacement limit
   lets them reach.
3. The casing distorts at the start of the run. A blade that would overlap with it there is held until it
   first passes a place where it touches nothing at rest.
4. On a stiff disk each blade vibrates by itself, as in `bladerub.contact.run`. A disk may couple the first
   modes of the blades (`bladerub.extras.rows.spec.Disk`).
5. The run ends for all blades in the element in which the first of them leaves the displacement limit.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np
import scipy.linalg
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.kernel.records import COATING
from bladerub.contact.laws import module_for
from bladerub.contact.modes import Modes, modes_at, tip_radii
from bladerub.contact.result import Energy, RunResult
from bladerub.contact.run import History, Segment
from bladerub.contact.setup import fixed_steps, set_up
from bladerub.contact.spec import RunSpec
from bladerub.contact.start import Seat
from bladerub.contact.strips import element_area
from bladerub.extras.rows.kernel import Coupling, RowSimulation
from bladerub.extras.rows.spec import Row, RowBlade
from bladerub.numerics.lanes import lanes_for

_TURN = 2 * np.pi

LONGEST_IMPULSE = 0.5
"""Phase of a coupled mode in the passage of an element up to which the impulses of the disk are accepted:
their relative error is a 24th of its square."""


@dataclass(frozen=True)
class RowResult:
    """Outcome of a run of a row, in SI units.

    Of each blade revolutions are counted from the start of the row, the wear is that of all, and the energy
    ledger lacks the work of the disk.
    """

    status: str  # as of `Outcome`, for the whole row
    message: str
    wear: np.ndarray  # (8, n_elements), permanent shortening under each node by all blades, m
    blades: tuple[RunResult, ...]  # in the order of the row
    worn_volume: np.ndarray  # (n_blades,), that each has worn off, m³
    unbounded: tuple[int, ...]  # numbers, counted from 1, of the blades that left the displacement limit
    disk_work: np.ndarray  # (n_blades,), on each blade, J
    disk_energy: float  # elastic, that the disk has taken up since the start, J

    @property
    def energy(self) -> Energy:
        """The ledgers of all blades together."""
        names = [entry.name for entry in fields(Energy)]
        return Energy(*(sum(getattr(blade.energy, name) for blade in self.blades) for name in names))

    @property
    def residual(self) -> float:
        """What the ledger of all blades, coating and disk misses, over the work exchanged in the contact."""
        total = self.energy
        return replace(total, elastic=total.elastic + self.disk_energy).residual


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_row(
    blade: ReducedBlade, spec: RunSpec, row: Row, progress: Callable[[int], None] | None = None
) -> RowResult:
    """Simulate the contact of a row of blades with one coating at one constant speed.

    `blade` is the nominal one. A row of one nominal blade at angle 0 makes the run of
    `bladerub.contact.run.simulate`, to the last bit. `progress` is called with the number of revolutions done
    after each of them. Raises `ValueError` as `simulate`; and if blades could meet, touch all around the
    casing or do not vibrate, or the disk couples modes that are not resolved, too fast or unstable.
    """
    modes, seats, simulation = set_up_row(blade, spec, row)
    stored = partial(_stored, row, modes, seats)
    initial = stored()
    _march(spec, seats, simulation, progress)
    results = tuple(seat.history.run_result(blade, seat.spec, seat.rule, seat.simulation) for seat in seats)
    unbounded = tuple(number for number, result in enumerate(results, 1) if result.status == "unbounded")
    first, area = results[unbounded[0] - 1 if unbounded else 0], element_area(blade, spec)
    by = f"blade {unbounded[0]}: " if unbounded and len(results) > 1 else ""
    worn = [seat.simulation.state.ledger[energy.WORN, : area.size] @ area for seat in seats]
    return RowResult(
        status=first.status,
        message=by + first.message,
        wear=results[0].wear,
        blades=results,
        worn_volume=np.array(worn),
        unbounded=unbounded,
        disk_work=simulation.work,
        disk_energy=stored() - initial,
    )


def set_up_row(blade: ReducedBlade, spec: RunSpec, row: Row) -> "tuple[Modes, list[_Seat], RowSimulation]":
    """Set up a row: modes of the nominal blade, the blades, and the loop that integrates them together."""
    modes, spec = modes_at(blade, spec.f_omega, spec), fixed_steps(blade, spec)
    seats: list[_Seat] = []
    for row_blade in row.blades:
        coating = {name: getattr(seats[0].simulation.state, name) for name in COATING} if seats else {}
        seats.append(_Seat(blade, spec, modes, row_blade, coating))
    apart, reach = _distances(blade, spec, seats)
    begins = [seat.first_clear() if len(seats) > 1 else 0 for seat in seats]
    lanes, law = lanes_for(blade.n_interface), spec.coating.element_law
    kernel = module_for(lanes, "extras.rows.kernel", law, spec.turns)
    coupling = _coupling(spec, modes, row, seats)
    at_once = min(spec.coating.n_elements // 2, min(apart) - reach)
    simulations, first = [seat.simulation for seat in seats], [seat.row for seat in seats]
    return modes, seats, kernel.RowSimulation(simulations, first, begins, coupling, apart, at_once)


def coupled_frequencies(modes: Modes, row: Row, mode: int, stiffness: np.ndarray) -> np.ndarray:
    """Find the natural angular frequencies (N,), rad/s, of a mode coupled by `stiffness` (N, N)."""
    factors = [blade.frequency_factors(modes.omega.size)[mode] for blade in row.blades]
    squares = scipy.linalg.eigvalsh(np.diag(np.square(factors)) + stiffness)
    if squares[0] <= 0:
        raise ValueError(
            f"row, disk, mode {mode + 1}: the stiffness of blades and disk must be positive definite"
        )
    return modes.omega[mode] * np.sqrt(squares)


class _Seat:
    """One blade of the row, its place and what is kept of its run."""

    def __init__(self, blade: ReducedBlade, spec: RunSpec, modes: Modes, row_blade: RowBlade, coating: dict):
        n_elements, damping_ratio = spec.coating.n_elements, spec.damping_ratio * row_blade.damping
        if damping_ratio >= 1:
            damping = f"damping = {row_blade.damping:g}"
            raise ValueError(f"row: {damping} makes a damping ratio of {damping_ratio:g}; must be below 1")
        position = row_blade.angle % _TURN / _TURN * n_elements
        self.spec = replace(spec, damping_ratio=damping_ratio)
        self.row = int(position)  # of the shared coating, which it passes at the start
        self.modes = modes._replace(omega=modes.omega * row_blade.frequency_factors(modes.omega.size))
        seat = Seat(position - self.row, row_blade.length, coating)
        self.rule, self.simulation = set_up(blade, self.spec, self.modes, seat)
        self.history = History(spec.revolutions, self.rule, self.simulation)

    def first_clear(self) -> int:
        """Elements up to the first place where it touches nothing at rest; `ValueError` if there is none."""
        clear = np.flatnonzero(np.roll(self.simulation.stator.minimum_gap, -self.row) > 0)
        if not clear.size:
            raise ValueError("row: a blade touches all around the casing at rest; make it shorter")
        return int(clear[0])


def _distances(blade: ReducedBlade, spec: RunSpec, seats: Sequence[_Seat]) -> tuple[list[int], int]:
    """Count the elements from each blade to the one behind it, and those that two reach over together."""
    n_elements, radius = spec.coating.n_elements, tip_radii(blade)[0]
    at_most = spec.tip.half_width + spec.displacement_limit * n_elements / (_TURN * radius.min())
    reach = math.ceil(2 * at_most) + 3  # a node stands anywhere within two elements, rows are whole
    around = sorted(range(len(seats)), key=lambda index: seats[index].row)
    apart = [n_elements] * len(seats)
    for index, next_index in zip(around, [*around[1:], around[0]], strict=True):
        if index == next_index:
            break
        distance = apart[next_index] = (seats[next_index].row - seats[index].row) % n_elements
        if distance <= reach:
            raise ValueError(
                f"row: blades {index + 1} and {next_index + 1} are {distance} of {n_elements} coating "
                f"elements apart; must be {reach + 1} or more, so that they cannot meet within the "
                "displacement limit"
            )
    return apart, reach


def _coupling(spec: RunSpec, modes: Modes, row: Row, seats: Sequence[_Seat]) -> Coupling:
    """Describe the disk for the time loop."""
    rules = [seat.rule for seat in seats]
    matrices, n_blades = row.disk.stiffness if row.disk else (), len(rules)
    n, impulse = len(matrices), np.zeros((len(matrices), n_blades, n_blades))
    resolved = min(rule.omega.size for rule in rules)
    if n > resolved:
        raise ValueError(f"row, disk: couples {n} modes; must be at most the {resolved} that are resolved")
    passage = rules[0].time_step * seats[0].simulation.steps_per_element
    for mode, matrix in enumerate(matrices):
        fastest = coupled_frequencies(modes, row, mode, np.array(matrix))[-1]
        if fastest * passage > LONGEST_IMPULSE:
            raise ValueError(
                f"row, disk: mode {mode + 1} of the {n} that it couples moves by {fastest * passage:.2g} rad "
                f"in the passage of an element; must be {LONGEST_IMPULSE:g} or less: couple fewer modes, or "
                "more weakly"
            )
        impulse[mode] = -0.5 * passage * modes.omega[mode] ** 2 * np.array(matrix)
    omega, kinetic = (
        np.array([getattr(rule, name)[:n] for rule in rules]).T for name in ("omega", "kinetic")
    )
    damping, h = np.array([seat.spec.damping_ratio for seat in seats]), rules[0].time_step
    damped = omega * np.sqrt(1.0 - damping**2)
    backward = -np.exp(damping * omega * h) * np.sin(damped * h) / damped
    return Coupling(
        impulse, *(np.ascontiguousarray(coefficients) for coefficients in (backward, kinetic, 0.5 * omega**2))
    )


def _stored(row: Row, modes: Modes, seats: Sequence[_Seat]) -> float:
    """Elastic energy of the disk, J."""
    total = 0.0
    for mode, matrix in enumerate(row.disk.stiffness if row.disk else ()):
        of_mode = np.array([seat.simulation.state.q[0, mode] for seat in seats])
        total += 0.5 * modes.omega[mode] ** 2 * float(of_mode @ np.array(matrix) @ of_mode)
    return total


def _march(
    spec: RunSpec, seats: Sequence[_Seat], simulation: RowSimulation, progress: Callable[[int], None] | None
) -> None:
    """Integrate all blades revolution by revolution, to the end or to that of one of them."""
    n_elements, begins = spec.coating.n_elements, simulation.begins.tolist()
    for revolution in range(spec.revolutions):
        displacement = np.full((len(seats), n_elements), np.nan)
        travel, blade_progress = simulation.advance(displacement, revolution * n_elements)
        for seat, begin, motion, of_blade in zip(seats, begins, displacement, blade_progress, strict=True):
            first = max(0, begin - revolution * n_elements)
            motion[: min(first, travel)] = 0.0
            seat.history.displacement[revolution] = motion
            if first < travel:
                seat.history.enter(of_blade, Segment(seat.simulation, revolution, first, travel))
        if not all(seat.history.is_within_limit for seat in seats):
            return
        if progress is not None:
            progress(revolution + 1)
