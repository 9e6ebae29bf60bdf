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


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
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
    return _Run(blade, spec).integrate(spec.revolutions, progress)


@threadpool_limits.wrap(limits=1, user_api="blas")
def simulate_longer(
    blade: ReducedBlade,
    spec: RunSpec,
    longer: Callable[[RunResult], int],
    progress: Callable[[int], None] | None = None,
) -> list[RunResult]:
    """Simulate a run as `simulate`, and on to so many revolutions as ``longer(result)`` says, if any.

    Returns the run, then the longer one if there is, which is that from rest to the last bit.
    """
    run = _Run(blade, spec)
    results = [run.integrate(spec.revolutions, progress)]
    if revolutions := longer(results[0]):
        results.append(run.integrate(revolutions, progress))
    return results


class _Run:
    """A run, integrated as far as it was asked for."""

    def __init__(self, blade: ReducedBlade, spec: RunSpec):
        self.blade, self.spec = blade, spec
        self.rule, self.simulation = set_up(blade, spec)
        self.initial = sum(energy.blade_energy(self.rule, self.simulation.state))
        self.history = History(0, spec.coating.n_elements)

    def integrate(self, revolutions: int, progress: Callable[[int], None] | None) -> RunResult:
        """Integrate up to the end of so many revolutions."""
        n_elements, done = self.spec.coating.n_elements, len(self.history.displacement)
        self.history.extend(revolutions)
        segments = (Segment(self.simulation, n, 0, n_elements) for n in range(done, revolutions))
        integrate(segments, self.history, progress)
        return run_result(self.blade, self.spec, self.rule, self.simulation, self.history, self.initial)


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
