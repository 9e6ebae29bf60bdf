"""The runs that a study asks for: what each one is, in which file and under which key."""

from dataclasses import dataclass, replace
from typing import Any

from bladerub.contact.laws import law_digest, motion_digest, solver_digest
from bladerub.contact.spec import RunSpec
from bladerub.io.sources import digest_of
from bladerub.settings.study import Config
from bladerub.study import cache
from bladerub.study.grid import CoatingCase, keeps_history, run_spec, speed_name, speeds
from bladerub.study.growth import confirmation_spec, growth_digest
from bladerub.study.manifest import CONFIRMATION
from bladerub.study.solver import row_of, rows, solver_of


@dataclass(frozen=True)
class PlannedRun:
    """One run of the study."""

    spec: RunSpec
    file: str  # in the folder of its coating
    keep_history: bool  # whether the whole radial displacement of node 1 is stored
    determinants: str  # digest of all that determines the file but the blade; other runs have no part in it
    row: Any = None  # the blades (`bladerub.study.solver`), where there is more than the one
    follow: bool = True  # whether it goes on for longer if it grows

    @property
    def n_blades(self) -> int:
        """Number of blades that rub."""
        return len(self.row.blades) if self.row else 1

    def key(self, blade_digest: str) -> str:
        """Key of this run of the blade with that digest (`bladerub.study.cache.blade_digest`)."""
        return cache.digest([self.determinants, blade_digest])


@dataclass(frozen=True)
class CoatingPlan:
    """All runs of one coating, at ascending speeds."""

    case: CoatingCase
    runs: tuple[PlannedRun, ...]


def planned_run(
    config: Config, spec: RunSpec, file: str, keep_history: bool, row: Any = None, follow: bool = True
) -> PlannedRun:
    """Plan one run (see `PlannedRun`); `config` is the study."""
    # the other keys of the analysis act on maps and tables
    shaping = {name: float(getattr(config.analysis, name)) for name in ("spectrum_revolutions", "max_order")}
    determinants = {
        "spec": spec,
        "solver": solver_digest(),
        **law_digest(spec.coating.element_law),
        **motion_digest(spec),
        "storage": storage_digest(),
        "keep_history": bool(keep_history),
        "analysis": shaping,
    }
    if row:
        determinants |= rows().determinants(row)
    else:  # what computes it decides the last bits, and with them a chaotic run
        determinants |= solver_of(config).determinants()
    return PlannedRun(spec, file, keep_history, cache.digest(determinants), row, follow)


def storage_digest() -> str:
    """Digest the source of what turns a result into its file."""
    return digest_of("study/store.py", "study/spectra.py")


def coating_plan(config: Config, case: CoatingCase) -> CoatingPlan:
    """Plan the runs of one coating at all speeds of the study `config`."""
    spec, row, runs = run_spec(config, case, f_omega=0.0), row_of(config), []
    for f_omega in speeds(config):
        history = keeps_history(config, case, f_omega)
        at_speed = replace(spec, f_omega=f_omega)  # what is the same at all speeds is one object
        runs.append(planned_run(config, at_speed, f"{speed_name(f_omega)}.h5", history, row))
    return CoatingPlan(case, tuple(runs))


def growth_key(config: Config) -> str:
    """Digest what decides which runs need a longer one, besides the runs themselves."""
    settings = config.analysis.divergence
    decisive = {**settings.plain(), "definition": growth_digest()}
    return cache.digest(decisive if settings.confirmation_revolutions else {})


def longer_run(config: Config, run: PlannedRun) -> PlannedRun:
    """Plan the longer run that shows whether the growth of `run` lasts."""
    spec = confirmation_spec(run.spec, config.analysis.divergence)
    return planned_run(config, spec, f"{CONFIRMATION}/{run.file}", keep_history=False, row=run.row)
