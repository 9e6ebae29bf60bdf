"""Many runs of one blade on a device: `RunSpec`s → `RunResult`s."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence

from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.schemes import Recurrence
from bladerub.contact.setup import set_up
from bladerub.contact.spec import RunSpec
from bladerub.extras.gpu import batch
from bladerub.extras.gpu.batch import Device, Variant


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_many(
    blade: ReducedBlade,
    specs: Sequence[RunSpec],
    device: Device,
    report: Callable[[int, str], None] = lambda runs, line: None,
) -> Iterator[tuple[int, RunResult]]:
    """Simulate runs on a device; yield the number of each with its result, in any order.

    One that the device does not know, or can't finish, is simulated here; `report` is told how many these
    are, with a line for a log. Raises as `bladerub.contact.run.simulate`.
    """
    variants: dict[Variant, list[tuple[int, Recurrence, Simulation]]] = defaultdict(list)
    left_out: dict[str, list[int]] = defaultdict(list)
    for number, spec in enumerate(specs):
        rule, simulation = set_up(blade, spec)
        if reason := batch.refusal(spec, simulation):
            left_out[reason].append(number)
        else:
            variants[batch.variant_of(spec, simulation)].append((number, rule, simulation))
    parts = [
        (variant, prepared[first : first + batch.MOST_RUNS])
        for variant, prepared in variants.items()
        for first in range(0, len(prepared), batch.MOST_RUNS)
    ]
    works = (batch.pack(variant, [simulation for *_, simulation in part]) for variant, part in parts)
    for (_, part), output in zip(parts, device(works), strict=True):
        for i, (number, rule, simulation) in enumerate(part):
            history = batch.finish(rule, simulation, output, i)
            if history is None:
                left_out["Newton's method did not converge in a step"].append(number)
            else:
                yield number, history.run_result(blade, specs[number], rule, simulation)
    for reason, numbers in left_out.items():
        report(len(numbers), f"{len(numbers)} of {len(specs)} runs on the CPU: {reason}")
        for number in numbers:
            yield number, simulate(blade, specs[number])
