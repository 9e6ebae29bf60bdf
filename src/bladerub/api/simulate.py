"""One run simulated, with the longer run of one that grows."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from bladerub.api.arguments import over
from bladerub.api.blade import Blade
from bladerub.api.display import bar, step
from bladerub.api.planned import StudyRun
from bladerub.api.run import Run, stress_measure
from bladerub.contact.setup import compile_kernel
from bladerub.study.grid import speed_name
from bladerub.study.job import compute_all
from bladerub.study.plan import CoatingPlan, planned_run
from bladerub.study.solver import row_of


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
    row, analysis = row or row_of(run.config), run.config.analysis
    if stress and row:
        raise ValueError("stress = True: is found for a single blade only, must be False with a row")
    if stress and (measure := stress_measure()) is None:  # before any work
        raise ValueError("stress = True: this package is without what finds the stress, must be False")
    stressed = measure.StressSolver(blade.mesh_path, analysis.spectrum_revolutions) if stress else None
    with step("compiling the time loop", progress):
        compile_kernel(run.spec.turns, blade.reduced.n_interface, run.spec.coating.element_law)
    with bar(run.spec.revolutions, "rev", progress) as line:

        def report(revolutions: int) -> None:
            if not line.n < revolutions <= line.total:  # of the longer run
                line.reset(analysis.divergence.confirmation_revolutions)
            line.update(revolutions - line.n)
            if each:
                each(revolutions)

        name = f"{speed_name(run.f_omega)}.h5"
        plan = CoatingPlan(run.case, (planned_run(run.config, run.spec, name, True, row, follow),))
        work = run.config, plan, blade.reduced, blade.digest
        (stored,), (longer,) = compute_all(*work, progress=report, solver=stressed)
    run_stress = stressed.stress if stressed else None
    if run_stress:
        stored = replace(stored, attributes=stored.attributes | run_stress.attributes())
    return Run(stored, Run(longer) if longer else None, run_stress, run.config)
