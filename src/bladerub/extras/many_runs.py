"""Many runs of a coating in Python, simulated at once."""

from bladerub.api.blade import Blade
from bladerub.api.display import bar, step
from bladerub.api.planned import StudyRun
from bladerub.api.run import Run
from bladerub.contact.setup import compile_kernel
from bladerub.extras.bounds import whole_number
from bladerub.study.job import compute_all
from bladerub.study.plan import CoatingPlan, planned_run
from bladerub.study.solver import row_of


def solve_all(
    blade: Blade, runs: list[StudyRun], jobs: int, follow: bool, progress: bool | None
) -> list[Run]:
    """Simulate `runs` of a coating, `jobs` at once, without histories; others as of `simulate`."""
    jobs = whole_number("jobs", jobs)
    with step("compiling the time loop", progress):
        compile_kernel(runs[0].spec.turns, blade.reduced.n_interface, runs[0].spec.coating.element_law)
    runs = [run.of_length(blade.length) for run in runs]  # perhaps not the study's own blade
    config, row = runs[0].config, row_of(runs[0].config)
    planned = [planned_run(config, run.spec, f"{n}.h5", False, row, follow) for n, run in enumerate(runs)]
    plan = CoatingPlan(runs[0].case, tuple(planned))
    with bar(len(runs), "run", progress) as line:
        stored, longer = compute_all(
            config, plan, blade.reduced, blade.digest, threads=jobs, advance=line.update
        )
    pairs = zip(stored, longer, strict=True)
    return [Run(run, Run(more) if more else None, config=config) for run, more in pairs]
