"""Runs simulated, with the longer run of one that grows: a single one, or many of a coating."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from bladerub.api.arguments import InputError, over
from bladerub.api.blade import Blade
from bladerub.api.display import bar, step
from bladerub.api.planned import StudyRun
from bladerub.api.run import Run, stress_measure
from bladerub.contact.setup import compile_kernel
from bladerub.study.grid import speed_name
from bladerub.study.growth import needs_confirmation
from bladerub.study.job import compute, compute_all
from bladerub.study.plan import CoatingPlan, PlannedRun, longer_run, planned_run
from bladerub.study.solver import Solve, row_of, solver_of
from bladerub.study.store import StoredRun


@over("run")
def simulate(
    blade: Blade,
    run: StudyRun,
    *,
    row: Any = None,
    follow: bool = True,
    stress: bool = False,
    progress: bool | None = None,
    each: Callable[[int], None] | None = None,
) -> Run:
    """Simulate one run.

    Parameters
    ----------
    blade : Blade
        The blade, from `build_blade` or `read_blade`.
    run : StudyRun
        The run, from `Study.run` or `StudyCoating.at`; a list of them gives a list of runs.
    row : Row, optional
        Blades that rub on one coating together, instead of the one: `Run.blades`. Default: those of the
        ``rotor`` of the study, if it has one.
    follow : bool
        Whether a run that grows is followed by one of more revolutions, as the study does: its `Run.longer`.
    stress : bool
        Whether the largest stress of the blade is found at rotation alone, at start-up and in the last
        ``analysis.spectrum_revolutions``: `Run.stress`, and attributes of the file. It is None where the
        blade is of matrices alone, which tell of no stress, or no revolution is complete.
    progress : bool, optional
        Whether a line on standard error shows what is being done. Default: if that is a terminal, and in a
        notebook.
    each : callable, optional
        Called with the number of revolutions done after each of them.

    Returns
    -------
    Run
        With the whole displacement of node 1.

    Raises
    ------
    InputError
        If the speed is outside the range of the blade, or was normalised for another one.
    ValueError
        If the time step of the study is too long for the scheme, or the row cannot be: its neighbours are
        too close, for instance, or its stress is asked for.
    OSError
        If the mesh of the blade, which the stress needs, is missing or damaged.

    Examples
    --------
    >>> import bladerub as br
    >>> run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19))
    >>> run.revolutions, run.status
    (20, 'completed')
    """
    blade.check_speed("f_omega", run.f_omega, run.f1_hz)
    run = run.of_length(blade.length)  # perhaps not the study's own blade
    row, solve, analysis = row or row_of(run.config), solver_of(run.config).simulate, run.config.analysis
    if stress and row:
        raise ValueError("stress = True: is found for a single blade only, must be False with a row")
    if stress and (measure := stress_measure()) is None:  # before any work
        raise ValueError("stress = True: this package is without what finds the stress, must be False")
    stressed = measure.StressSolver(blade.mesh_path, analysis.spectrum_revolutions) if stress else None
    with step("compiling the time loop", progress):
        compile_kernel(run.spec.turns, blade.reduced.n_interface, run.spec.coating.element_law)
    with bar(run.spec.revolutions, "rev", progress) as line:

        def report(revolutions: int) -> None:
            if revolutions < line.n:  # of the longer run
                line.reset(analysis.divergence.confirmation_revolutions)
            line.update(revolutions - line.n)
            if each:
                each(revolutions)

        def computed(planned: PlannedRun, solve: Solve) -> StoredRun:
            key = planned.key(blade.digest)
            return compute(run.case, planned, blade.reduced, key, analysis, report, solve)

        planned = planned_run(run.config, run.spec, f"{speed_name(run.f_omega)}.h5", True, row)
        stored, longer = computed(planned, stressed or solve), None
        amplitude, status = stored.data["revolution_amplitude"], stored.attributes["status"]
        if follow and needs_confirmation(amplitude, status, analysis.divergence):
            longer = Run(computed(longer_run(run.config, planned), solve))
    run_stress = stressed.stress if stressed else None
    if run_stress:
        stored = replace(stored, attributes=stored.attributes | run_stress.attributes())
    return Run(stored, longer, run_stress, run.config)


def solve_all(
    blade: Blade, runs: list[StudyRun], jobs: int, follow: bool, progress: bool | None
) -> list[Run]:
    """Simulate `runs` of a coating, `jobs` at once, without histories; other arguments as of `simulate`."""
    if not isinstance(jobs, int) or jobs < 1:
        raise InputError("jobs", jobs, "must be at least 1")
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
