"""Runs from rest: `RunSpec` → `RunResult`."""

from collections.abc import Callable

from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact import energy
from bladerub.contact.integration import History, Segment, integrate
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.result import RunResult
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
from bladerub.contact.spec import RunSpec


def simulate(blade: ReducedBlade, spec: RunSpec, progress: Callable[[int], None] | None = None) -> RunResult:
    """Simulate the contact of a blade with the coating at one constant speed.

    1. Eq. (1) is solved in the modal coordinates of the reduced blade at this speed, with modal
       damping, by the scheme that the spec names (contract: `bladerub.contact.schemes`).
    2. A whole number of steps makes the passage of one coating element: as few as the tolerance of the run
       allows (`bladerub.contact.steps`).
    3. Displacements are increments about the running position of the blade, and so are clearances.
    4. The contact force of a node is along the normal to the casing where the node is, turned by θ
       against the rotation, or by Coulomb's law against the sliding of the node
       (`bladerub.contact.friction`); tangential displacement is positive with the rotation.
    5. The blade starts at rest, deflected in its first mode where the spec says so.

    `bladerub.contact.reference` has the whole model on a page. `progress` is called with the number of
    revolutions done after each of them. What was computed until a displacement exceeded the limit is kept.
    Raises `ValueError` if the speed is outside the range of the blade, or the step too long for the scheme.
    """
    return simulate_longer(blade, spec, lambda result: 0, progress)[0]


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_longer(
    blade: ReducedBlade,
    spec: RunSpec,
    longer: Callable[[RunResult], int],
    progress: Callable[[int], None] | None = None,
) -> list[RunResult]:
    """Simulate a run as `simulate`, and on to so many revolutions as ``longer(result)`` says, if any.

    Returns the run, then the longer one if there is, which is that from rest to the last bit.
    """
    rule, simulation = set_up(blade, spec)
    initial, n_elements = sum(energy.blade_energy(rule, simulation.state)), spec.coating.n_elements
    history = History(0, n_elements)

    def result_after(revolutions: int) -> RunResult:
        done = len(history.displacement)
        history.extend(revolutions)
        integrate(
            (Segment(simulation, n, 0, n_elements) for n in range(done, revolutions)), history, progress
        )
        return run_result(blade, spec, rule, simulation, history, initial)

    results = [result_after(spec.revolutions)]
    if revolutions := longer(results[0]):
        results.append(result_after(revolutions))
    return results


def run_result(
    blade: ReducedBlade,
    spec: RunSpec,
    rule: Recurrence,
    simulation: Simulation,
    history: History,
    initial: float,
) -> RunResult:
    """Sum up a run that had `initial` energy (J) in the blade at its start."""
    ledger = simulation.state.ledger
    return RunResult(
        **history.outcome(blade, spec, rule, simulation, initial),
        time_step=rule.time_step,
        n_reversed_steps=int(ledger[energy.REVERSED, 0]),
        slowest_sliding=1.0 - float(ledger[energy.RETREAT].max()) * simulation.steps_per_element,
        n_fallback_steps=int(ledger[energy.FALLBACK, 0]),
        n_unconverged_steps=int(ledger[energy.UNCONVERGED, 0]),
        n_modes=rule.omega.size,
    )
