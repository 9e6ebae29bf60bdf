"""Many runs of one blade on a device: packed as the loop on a GPU reads them, and finished by what it leaves.

Runs of one blade at one speed, or of one coating, share what is equal: it is packed once.
"""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.kernel import elements, free_flight, newton
from bladerub.contact.kernel.free_flight import FreeFlight
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.kernel.modal import Modal
from bladerub.contact.laws import module_of, source_of
from bladerub.contact.result import RunResult
from bladerub.contact.run import History, simulate
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
from bladerub.contact.spec import ElementLaw, RunSpec
from bladerub.extras.gpu import formulas
from bladerub.numerics.vectors import LANES

WARP = 32  # lanes of a warp: four groups of the `LANES` nodes
MOST_RUNS = 4096  # runs of a piece of work at most: what a device leaves of each takes half a megabyte
COMPLETED, UNBOUNDED, HANDED_OVER = range(3)  # a run ended, left the limit, or the loop can't go on
COUNTS = ("status", "revolutions", "steps", "last_steps", "contact_steps", "reversed_steps")

# Entries of the ledger in the order of ``loop.cu``: a group of lanes each, and the sum of the groups
_OF_NODES = (
    *(energy.RADIAL, energy.TANGENTIAL, energy.SLIDING, energy.TORQUE),
    *(energy.EXCHANGED, energy.RETREAT, energy.COUPLE),
)
_OF_ELEMENTS = (
    *(energy.SHAPE, energy.WEAR, energy.STORED, energy.STORED_BEFORE, energy.LAST_SHAPE, energy.LAST_WEAR),
    energy.DAMPING,
)
_LEDGER_ROWS = 2 + len(_OF_ELEMENTS) - 1
FOLDER = Path(__file__).parent
_FORMS = ("INCREMENT_Q", "INCREMENT_D", "LAST_STEP_Q", "LAST_STEP_D", "LOSS_QQ", "LOSS_QD", "LOSS_DD")
_FORMS += ("MEAN_Q", "MEAN_D", "BOUND_Q", "BOUND_D")


class Variant(NamedTuple):
    """What is compiled in: runs of one variant can be in one batch."""

    vectors: int  # Vectors of 32 modes
    turns: bool  # Whether the profile turns with the tip
    rows: int  # Of elements under a node, for each group of lanes
    law: ElementLaw  # Of the elements, without its parameters
    n_elements: int
    revolutions: int


def refusal(spec: RunSpec, simulation: Simulation) -> str:
    """Say why a run is not one for the GPU; empty if it is."""
    if spec.coating.is_rigid:
        return "contact with the rigid casing is solved node by node"
    if spec.coating.coulomb:
        return "Coulomb's law needs the sliding of each node"
    if simulation.layer is not None:
        return f"the law {spec.coating.element_law.name} conducts heat between revolutions"
    if simulation.modal.corrects:
        return f"the scheme {spec.scheme} corrects its steps"
    if simulation.tip.start.size > LANES:
        return f"the tip has more than {LANES} nodes"
    return _formulas_of(replace(spec.coating.element_law, parameters=()))[1]


@cache  # a translation takes as long as setting up a run
def _formulas_of(law: ElementLaw) -> tuple[str, str]:
    """Formulas of a law, or why there are none."""
    try:
        return formulas.of_law(module_of(law), source_of(law)), ""
    except ValueError as error:
        return "", str(error)


def variant_of(spec: RunSpec, simulation: Simulation) -> Variant:
    """Return the variant of the loop that a run needs."""
    return Variant(
        vectors=math.ceil(simulation.modal.n / WARP),
        turns=simulation.modal.tip.shape[1] > 2 * LANES,
        rows=math.ceil((2 * spec.tip.half_width + 3) / 4),
        law=replace(spec.coating.element_law, parameters=()),
        n_elements=spec.coating.n_elements,
        revolutions=spec.revolutions,
    )


@cache
def source(variant: Variant) -> str:
    """Put together the source of the loop for runs of a variant."""
    constants = {"MODES": variant.vectors, "TURNS": int(variant.turns), "ROWS": variant.rows}
    constants |= {"SHARED": _shared(variant), "MAX_ITERATIONS": newton.MAX_ITERATIONS}
    constants |= {"N_FORMS": free_flight.N_FORMS}
    constants |= {name: getattr(free_flight, name) // LANES * WARP for name in _FORMS}
    numbers = {"TOLERANCE": newton.TOLERANCE, "STRAIGHT": newton.STRAIGHT}
    numbers |= {"NO_CHANGE": elements.NO_CHANGE, "NO_ADVANCE": elements.NO_ADVANCE}
    lanes, loop = ((FOLDER / name).read_text(encoding="utf-8") for name in ("lanes.h", "loop.cu"))
    parts = [f"constexpr int {name} = {value};" for name, value in constants.items()]
    parts += [f"constexpr double {name} = {value!r};" for name, value in numbers.items()]
    return "\n".join([lanes, *parts, formulas.of_contact(), _formulas_of(variant.law)[0], loop])


class Work(NamedTuple):
    """What a device is given: a program, and the arrays that it reads."""

    source: str
    shared: int  # Doubles that a warp keeps in shared memory
    n_elements: int
    revolutions: int
    modal: np.ndarray  # Records, one in a row
    stator: np.ndarray
    casing: np.ndarray
    tip: np.ndarray
    runs: np.ndarray  # (n, 5): Numbers of the records of each run, and its steps in an element
    modes: np.ndarray  # (n, 2, modes): Modal coordinates at the start, and their last increment


class Output(NamedTuple):
    """What a device leaves of n runs."""

    modes: np.ndarray  # (n, 2, modes): As in `Work`, at the end
    wear: np.ndarray  # (n, N, 8), m
    displacement: np.ndarray  # (n, revolutions, N): Of node 1, mean over each element, m
    range: np.ndarray  # (n, revolutions, 2): Of that displacement, m
    forces: np.ndarray  # (n, 2, 24): On the blade now and one step before
    ledger: np.ndarray  # (n, rows, 32)
    counts: np.ndarray  # (n, 6): See `COUNTS`


Device = Callable[[Iterable[Work]], Iterator[Output]]
"""What carries out the loop for pieces of work: a GPU, or an emulation of one."""


def longest_first(works: Sequence[Work]) -> np.ndarray:
    """Return the piece and the number (n, 2) of every run of some pieces, the longest ones first."""
    steps = [work.runs[:, 4] * work.n_elements * work.revolutions for work in works]
    runs = [(piece, run) for piece, of_piece in enumerate(steps) for run in range(len(of_piece))]
    return np.array(runs, dtype=np.int32)[np.argsort(-np.concatenate(steps), kind="stable")]


def described_to_loop(work: Work, addresses: Iterable[int]) -> np.ndarray:
    """Describe ``Batch`` of ``loop.cu``; `addresses`: of arrays in the order of `Work`, then `described`."""
    return np.array([work.n_elements, work.revolutions, *addresses], dtype=np.int64)


def described(work: Work) -> dict[str, tuple[tuple[int, ...], type, float]]:
    """Shape, type and initial value of what a device leaves, but for the modes, by its name in `Output`."""
    n, elements_, revolutions = len(work.runs), work.n_elements, work.revolutions
    return {
        "wear": ((n, elements_, LANES), np.float64, 0.0),
        "displacement": ((n, revolutions, elements_), np.float64, np.nan),
        "range": ((n, revolutions, 2), np.float64, np.nan),
        "forces": ((n, 2, 3 * LANES), np.float64, 0.0),
        "ledger": ((n, _LEDGER_ROWS + 1, WARP), np.float64, 0.0),
        "counts": ((n, len(COUNTS)), np.int64, 0),
    }


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_many(
    blade: ReducedBlade,
    specs: Sequence[RunSpec],
    device: Device,
    report: Callable[[int, str], None] = lambda runs, line: None,
) -> Iterator[tuple[int, RunResult]]:
    """Simulate runs on a device; yield the number of each with its result, in any order.

    One that the device does not know, or can't finish, is simulated here; `report` is told how many these
    are, with a line for a log. Raises as `simulate`.
    """
    variants: dict[Variant, list[tuple[int, Recurrence, Simulation]]] = defaultdict(list)
    left_out: dict[str, list[int]] = defaultdict(list)
    for number, spec in enumerate(specs):
        rule, simulation = set_up(blade, spec)
        if reason := refusal(spec, simulation):
            left_out[reason].append(number)
        else:
            variants[variant_of(spec, simulation)].append((number, rule, simulation))
    parts = [
        (variant, prepared[first : first + MOST_RUNS])
        for variant, prepared in variants.items()
        for first in range(0, len(prepared), MOST_RUNS)
    ]
    works = (pack(variant, [simulation for *_, simulation in part]) for variant, part in parts)
    for (_, part), output in zip(parts, device(works), strict=True):
        for i, (number, rule, simulation) in enumerate(part):
            history = finish(rule, simulation, output, i)
            if history is None:
                left_out["Newton's method did not converge in a step"].append(number)
            else:
                yield number, history.run_result(blade, specs[number], rule, simulation)
    for reason, numbers in left_out.items():
        report(len(numbers), f"{len(numbers)} of {len(specs)} runs on the CPU: {reason}")
        for number in numbers:
            yield number, simulate(blade, specs[number])


def pack(variant: Variant, simulations: Sequence[Simulation]) -> Work:
    """Pack runs of one variant, which are about to begin, for a device."""
    turns = variant.turns
    runs = np.empty((len(simulations), 5), dtype=np.int32)
    modes = np.zeros((len(simulations), 2, WARP * variant.vectors))
    tables: list[dict[bytes, int]] = [{} for _ in range(4)]  # numbers of records, those of each kind once
    for i, simulation in enumerate(simulations):
        stator, tip = simulation.stator, simulation.tip
        tilt = stator.further_compliance if turns else np.zeros(LANES)
        factors = [stator.normal_factor, stator.tangential_factor]
        scalars = [tip.half_width, tip.curvature, tip.search_range, tip.limit]
        records = (
            _modal_record(simulation.modal, simulation.flight, variant.vectors, turns),
            np.concatenate([stator.law.ravel(), stator.self_compliance, tilt, factors]),
            np.concatenate([stator.initial_gap.ravel(), stator.minimum_gap]),
            np.concatenate([tip.start, tip.per_metre, tip.radius, tip.lever, scalars]),
        )
        for kind, (table, record) in enumerate(zip(tables, records, strict=True)):
            runs[i, kind] = table.setdefault(record.tobytes(), len(table))
        runs[i, 4] = simulation.steps_per_element
        q, before, _ = simulation.state.q
        modes[i, :, : q.size] = q, q - before
    packed = (np.array([np.frombuffer(record) for record in table]) for table in tables)
    return Work(
        *(source(variant), _shared(variant), variant.n_elements, variant.revolutions, *packed, runs, modes)
    )


def finish(rule: Recurrence, simulation: Simulation, output: Output, i: int) -> History | None:
    """Bring a simulation to its end by what was left of run `i`; None where it was handed over."""
    counts = dict(zip(COUNTS, output.counts[i].tolist(), strict=True))
    if counts["status"] == HANDED_OVER:
        return None
    history = History(len(output.displacement[i]), rule, simulation)
    state, (q, increment) = simulation.state, output.modes[i]
    n = state.q.shape[1]
    state.q[:] = q[:n], (q - increment)[:n], q[:n]  # all damping is in the ledger
    state.force[:] = output.forces[i].reshape(state.force.shape)
    state.wear[:] = output.wear[i]
    groups = output.ledger[i].reshape(-1, WARP // LANES, LANES)
    state.ledger[list(_OF_NODES)] = groups[:2].reshape(-1, LANES)[: len(_OF_NODES)]
    state.ledger[list(_OF_ELEMENTS)] = groups[2:].sum(axis=1)
    state.ledger[energy.WORN] = state.wear.sum(axis=0)
    state.ledger[energy.REVERSED, 0] = counts["reversed_steps"]
    history.displacement[:] = output.displacement[i]
    history.range[:] = output.range[i]
    history.n_steps, history.n_contact_steps = counts["steps"], counts["contact_steps"]
    history.is_within_limit = counts["status"] == COMPLETED
    history.revolutions_made = float(counts["revolutions"])
    if not history.is_within_limit:
        travel = counts["last_steps"] / simulation.steps_per_element
        history.revolutions_made += travel / output.displacement.shape[2]
    return history


def _shared(variant: Variant) -> int:
    sums = 3 * LANES if variant.turns else 2 * LANES
    return 3 * LANES + WARP * _LEDGER_ROWS + (4 + sums) * WARP * variant.vectors


def _modal_record(modal: Modal, flight: FreeFlight, vectors: int, turns: bool) -> np.ndarray:
    lane, padding = np.arange(WARP), WARP * vectors - modal.n
    node, group = lane % LANES, lane // LANES
    row = node + LANES * (lane >= WARP // 2)  # of the tip

    def padded(rows: np.ndarray) -> np.ndarray:
        return np.pad(rows, [(0, 0)] * (rows.ndim - 1) + [(0, padding)])

    def flat(blocks: np.ndarray) -> np.ndarray:
        return padded(blocks.swapaxes(0, 1).reshape(blocks.shape[1], -1))

    coefficients = padded(np.array([modal.now - modal.before - 1.0, modal.before, modal.loss, modal.gain]))
    tip = flat(modal.tip).reshape(-1, vectors, WARP)
    slots = [tip[row ^ s, :, lane].T for s in range(2 * LANES)]  # slot s of a lane, see `project`
    width = 3 * LANES if turns else 2 * LANES
    if turns:
        slots += [tip[2 * LANES + (node ^ s), :, lane].T for s in range(LANES)]
    compliance = modal.compliance
    response = [compliance[width // 2 * (group & 1) + k, row] for k in range(width // 2)]
    if turns:
        response += [compliance[width // 4 * group + k, 2 * LANES + node] for k in range(width // 4)]
    projection = np.stack(slots, axis=1)  # (vectors, slots, 32)
    parts = [part.ravel() for part in (coefficients, projection, flat(flight.forms), np.array(response))]
    return np.concatenate([*parts, [float(flight.n_steps), flight.sideways]])
