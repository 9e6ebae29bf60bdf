"""An ensemble: one run from many starts."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.api.arguments import InputError, over
from bladerub.api.blade import Blade
from bladerub.api.display import Shown
from bladerub.api.planned import StudyRun
from bladerub.api.run import Run, run_of, runs_of
from bladerub.extras.bounds import whole_number
from bladerub.extras.ensembles.bands import band
from bladerub.extras.ensembles.ensemble import starts
from bladerub.extras.many_runs import solve_all
from bladerub.io.equality import Comparable
from bladerub.io.errors import DamagedFile
from bladerub.io.provenance import PREFIX, config_digest, provenance
from bladerub.study.grid import speed_name
from bladerub.study.plan import planned_run
from bladerub.study.solver import row_of
from bladerub.study.store import StoredRun, read_runs, write_runs
from bladerub.study.summary import spectral_peak

_START = "initial_displacement"  # attribute of each run in the file of an ensemble, m
_CONFIG = f"{PREFIX}config_sha256"
_LENGTHS = ["peak_amplitude", "spectral_peak", "max_wear"]
_BANDED = (*_LENGTHS, "lobes", "wear_harmonic", "growth_per_revolution")


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble(Shown, Comparable):
    """One run and its repetitions from other starts, from `simulate_ensemble`.

    Parameters
    ----------
    planned : StudyRun
        The run.
    start : ndarray
        Radial displacement of node 1 at the start of each run (n,), m: 0 of the first.
    runs : tuple of Run
        The runs (n,), the study's own first.

    Examples
    --------
    >>> planned = study.run("2nd", E=2, K=0.5, f_omega=0.19)
    >>> ensemble = br.simulate_ensemble(blade, planned, members=2, progress=False)
    >>> len(ensemble.runs), float(ensemble.start[0])
    (3, 0.0)
    >>> list(ensemble.to_pandas().status)
    ['completed', 'completed', 'completed']
    >>> list(ensemble.bands().columns)
    ['median', 'low', 'high']
    >>> ensemble.write("ensemble.h5")
    >>> br.read_ensemble("ensemble.h5", planned) == ensemble
    True
    """

    planned: StudyRun = field(repr=False)
    start: np.ndarray = field(repr=False)
    runs: tuple[Run, ...] = field(repr=False)

    def to_pandas(self) -> pd.DataFrame:
        """Return a row for each run: ``start`` (m), and the keys of `Run.summary`.

        ``spectral_peak`` (m) is the largest amplitude of the spectrum above order 0.5.
        """
        rows = []
        for start, run in zip(self.start, self.runs, strict=True):
            _, height = spectral_peak(run.spectrum.index.to_numpy(), run.spectrum.to_numpy())
            rows.append({"start": start, "spectral_peak": height, **run.summary(self.planned.config)})
        return pd.DataFrame(rows)

    def bands(self) -> pd.DataFrame:
        """Return a row for each quantity: median, and ``low`` to ``high``, the 90 % band.

        A further start falls between these with that probability (`bladerub.extras.ensembles.bands`). The
        quantities are ``peak_amplitude``, ``spectral_peak``, ``max_wear`` (m), ``lobes``, ``wear_harmonic``
        and ``growth_per_revolution``.
        """
        table = self.to_pandas()
        return pd.DataFrame({name: band(table[name])._asdict() for name in _BANDED}).T

    def write(self, path: str | Path) -> None:
        """Write all runs, with their longer ones, to the HDF5 file `path`, whole or not at all.

        The names of the members begin with ``member_1_``, ``member_2_`` and so on; those of the run itself
        are those of `Run.write`.

        Raises
        ------
        OSError
            If it cannot be written; the message names the file.
        """
        together: dict[str, StoredRun] = {}
        for number, (start, run) in enumerate(zip(self.start.tolist(), self.runs, strict=True)):
            prefix = _prefix(number)
            together |= runs_of(run, prefix)
            together[prefix] = replace(run.stored, attributes=run.attributes | {_START: start})
        write_runs(path, together, provenance(self.planned.config.plain()))

    def _shown(self) -> tuple[str, Mapping[str, str]]:
        table = self.bands()
        table.loc[_LENGTHS] *= 1e3
        units = dict.fromkeys(_LENGTHS, " mm")
        bands = {
            name: f"{low:.4g} to {high:.4g}{units.get(name, '')}" for name, (_, low, high) in table.iterrows()
        }
        return f"Ensemble of {len(self.runs)} runs", {"run": self.planned.name, **bands}


@over("run")
def simulate_ensemble(
    blade: Blade,
    run: StudyRun,
    members: int = 8,
    *,
    own: Run | None = None,
    jobs: int = 1,
    follow: bool = True,
    progress: bool | None = None,
) -> Ensemble:
    """Simulate one run, and again from `members` other starts within ``ensemble.displacement``.

    A chaotic run amplifies so small a difference until it is one draw of many; other runs stay as they are.

    Parameters
    ----------
    blade : Blade
        The blade.
    run : StudyRun
        The run, from `Study.run` or `StudyCoating.at`; a list of them gives a list of ensembles.
    members : int
        Further starts, at least one: the first of them are those of the study.
    own : Run, optional
        What `simulate` gave for the run, if it did; otherwise it is simulated as well.
    jobs : int
        Runs at once.
    follow, progress : bool, optional
        As of `simulate`.

    Returns
    -------
    Ensemble
        The run itself and its members.

    Raises
    ------
    InputError
        If the speed is outside the range of the blade, there are no members, or `own` is of another run.

    Examples
    --------
    >>> import bladerub as br
    >>> planned = study.run("2nd", E=2, K=0.5, f_omega=0.19)
    >>> ensemble = br.simulate_ensemble(blade, planned, members=2, jobs=2, progress=False)
    >>> ensemble.runs[1].attributes["run_key"] == ensemble.runs[0].attributes["run_key"]
    False
    """
    members = whole_number("members", members)
    blade.check_speed("f_omega", run.f_omega, run.f1_hz)
    if own is not None:
        _check_own(blade, run, own)
    runs = [] if own is None else [own]
    start = np.append(0.0, starts(run.config.plugged("ensemble"), run.case, run.f_omega, members))
    specs = [replace(run.spec, initial_displacement=u) for u in start.tolist()[len(runs) :]]
    runs += solve_all(blade, [replace(run, spec=spec) for spec in specs], jobs, follow, progress)
    return Ensemble(run, start, tuple(runs))


def read_ensemble(path: str | Path, run: StudyRun) -> Ensemble:
    """Read the ensemble of a run that `Ensemble.write` wrote.

    Parameters
    ----------
    path : path
        The file.
    run : StudyRun
        The run, as `simulate_ensemble` was given it: files do not hold the config of their study.

    Raises
    ------
    OSError
        If the file is missing, damaged or no ensemble; the message names it.
    InputError
        If it is of another study, coating or speed.

    Examples
    --------
    >>> import bladerub as br
    >>> planned = study.run("2nd", E=2, K=0.5, f_omega=0.19)
    >>> ensemble = br.simulate_ensemble(blade, planned, members=1, progress=False)
    >>> ensemble.write("ensemble.h5")
    >>> br.read_ensemble("ensemble.h5", planned) == ensemble
    True
    """
    stored = read_runs(path)
    numbers = range(sum(_START in stored_run.attributes for stored_run in stored.values()))
    if not numbers or any(_prefix(number) not in stored for number in numbers):
        raise DamagedFile(f"{path}: no ensemble, {_START} of its runs is missing")
    start = np.array([stored[_prefix(number)].attributes.pop(_START) for number in numbers])
    ensemble = Ensemble(run, start, tuple(run_of(stored, _prefix(number)) for number in numbers))
    _check(run, ensemble.runs[0], path)
    if stored[""].attributes.get(_CONFIG) != config_digest(run.config.plain()):
        raise InputError("run", run.name, f"must be of the study of {path}, whose config is another one")
    return ensemble


def _check_own(blade: Blade, run: StudyRun, own: Run) -> None:
    """Refuse an `own` that is no outcome of this `run` of the `blade`, with or without its history."""
    if not isinstance(own, Run):
        raise InputError("own", own, "must be a Run")
    _check(run, own, "own")
    config, spec = run.config, run.of_length(blade.length).spec
    planned = (planned_run(config, spec, "", history, row_of(config)) for history in (True, False))
    if own.attributes["run_key"] not in {of_run.key(blade.digest) for of_run in planned}:
        raise InputError("own", run.name, "must be of the same blade, study and solver as the ensemble")


def _check(run: StudyRun, first: Run, origin: str | Path) -> None:
    """Refuse a `run` that is not the `first` one of an ensemble, by coating, speed and length."""
    revolutions = run.spec.revolutions
    if (first.case, first.f_omega, first.revolutions) != (run.case, run.f_omega, revolutions):
        content = f"{first.case.name}/{speed_name(first.f_omega)} of {first.revolutions} revolutions"
        request = f"{run.name} of {revolutions} revolutions"
        raise InputError("run", request, f"must be that of {origin}, {content}")


def _prefix(number: int) -> str:
    return f"member_{number}_" if number else ""
