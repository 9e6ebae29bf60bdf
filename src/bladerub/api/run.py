"""The outcome of one run, simulated here or read from its file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from bladerub import plots, plugins
from bladerub.api.arguments import InputError, over
from bladerub.api.display import Shown
from bladerub.api.study import settings_of
from bladerub.contact.result import ENERGIES, Energy
from bladerub.io import hdf5
from bladerub.io.errors import package
from bladerub.io.provenance import PREFIX, provenance
from bladerub.io.values import equal
from bladerub.plots import titles
from bladerub.settings.analysis import Divergence
from bladerub.settings.study import Config
from bladerub.settings.units import speed_in_words
from bladerub.study import store
from bladerub.study.divergence import in_a_word
from bladerub.study.grid import CoatingCase, modulus_unit
from bladerub.study.growth import Verdict, judge
from bladerub.study.manifest import confirmation_path, lists_longer
from bladerub.study.summary import displacement_peak, summarise, worn_through

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LONGER = "longer_"


@dataclass(frozen=True, eq=False, repr=False)
class Run(Shown):
    """Outcome of one run, from `simulate` or `read_run`.

    Parameters
    ----------
    stored : StoredRun
        Attributes and datasets, as they are or would be in the file of the run. SI units.
    longer : Run, optional
        The same for more revolutions, where the amplitude grows: it shows whether the growth lasts.
    stress : RunStress, optional
        The largest stress of the blade, where `simulate` was asked for it.
    config : Config, optional
        That of its study, if it was simulated here.

    Examples
    --------
    >>> run.status, run.revolutions, run.f_omega, run.case.name
    ('completed', 3, 0.19, '2nd_E2_K0.5_theta0')
    >>> run.wear.shape, run.angle.shape
    ((8, 2000), (2000,))
    >>> run.layer  # the law of the paper leaves nothing but wear
    {}
    >>> run.revolution_peak.size, run.revolution_amplitude.size, run.radial_displacement.size
    (3, 3, 6000)
    >>> bool(run.spectrum.max() < run.revolution_peak.max())
    True
    >>> run.energy.residual < 1e-3
    True
    >>> round(run.f1_hz) == round(blade.f1_hz)
    True
    >>> run.attributes["n_unconverged_steps"]
    0
    >>> len(run.blades)  # no row of blades, but a single one
    0
    >>> run.verdict().divergent
    False
    >>> run.summary()["status"]
    'completed'
    >>> run.to_xarray()["wear"].units
    'm'
    >>> list(run.to_pandas().index)
    [1, 2, 3]
    >>> figure = run.plot_wear("wear.png")
    >>> figure = run.plot_history("history.png")
    >>> figure = run.plot_spectrum("spectrum.png")
    """

    stored: store.StoredRun = field(repr=False)
    longer: "Run | None" = None
    stress: Any = None
    config: Config | None = field(default=None, repr=False)

    def __eq__(self, other: object) -> bool:
        return equal(_content(self), _content(other)) if isinstance(other, Run) else NotImplemented

    @property
    def attributes(self) -> dict[str, Any]:
        """What the run is, and its counters: the attributes of its file."""
        return self.stored.attributes

    @property
    def case(self) -> CoatingCase:
        """Casing, coating and law of friction, normalised."""
        return CoatingCase.described(self.attributes)

    @property
    def f_omega(self) -> float:
        """Rotational frequency over the first eigenfrequency at rest."""
        return self.attributes["f_omega"]

    @property
    def f1_hz(self) -> float | None:
        """First frequency of its blade at rest, Hz, by the time step; None of an unbounded run."""
        steps = self.attributes["n_steps"] * self.attributes["time_step"] / max(1, len(self.blades))
        return self.revolutions / (self.f_omega * steps) if self.status == "completed" else None

    @property
    def revolutions(self) -> int:
        """Length of the run."""
        return self.attributes["revolutions"]

    @property
    def status(self) -> str:
        """``"completed"``, or ``"unbounded"`` when a displacement exceeded the limit."""
        return self.attributes["status"]

    @property
    def angle(self) -> np.ndarray:
        """Casing angle (n,) of the element centres, rad."""
        return self.stored.data["angle"]

    @property
    def wear(self) -> np.ndarray:
        """Permanent shortening (8, n) of the coating under each interface node, m."""
        return self.stored.data["wear"]

    @property
    def layer(self) -> dict[str, np.ndarray]:
        """What else than wear the law of the coating leaves in the elements (8, n), by name; SI units."""
        return self.stored.layer

    @property
    def energy(self) -> Energy:
        """Energy ledger, J; ``energy.residual`` is what it misses, relative."""
        return Energy(**{name: float(self.stored.data[f"energy_{name}"]) for name in ENERGIES})

    @property
    def radial_displacement(self) -> np.ndarray:
        """Radial displacement of node 1 over the run, m: mean over the passage of each element.

        Raises `InputError` if the file of the run does not hold it.
        """
        if "radial_displacement" not in self.stored.data:
            reason = "the study keeps the displacement of runs under analysis.histories alone; simulate it"
            raise InputError("radial_displacement", None, reason)
        return self.stored.data["radial_displacement"]

    @property
    def revolution_peak(self) -> np.ndarray:
        """Largest absolute radial displacement of node 1 in each revolution, m; NaN after an early end."""
        return self.stored.data["revolution_peak"]

    @property
    def revolution_amplitude(self) -> np.ndarray:
        """Half the range of the radial displacement of node 1 in each revolution, m; NaN likewise."""
        return self.stored.data["revolution_amplitude"]

    @property
    def spectrum(self) -> pd.Series:
        """Amplitude of the radial displacement of node 1 (m) by engine order, over the last revolutions."""
        data = self.stored.data
        order = pd.Index(data["spectrum_order"], name="engine_order")
        return pd.Series(data["spectrum_amplitude"], order, name="amplitude")

    @property
    def blades(self) -> pd.DataFrame:
        """A row for each blade of a row: what it is and what it did, SI units; none for a single blade.

        The columns are the datasets ``blade_…`` of its file. The other results are of the blade
        ``attributes["blade"]``, which vibrates most, but for the wear and the energy, which are of all.
        """
        data, names = self.stored.data, [name for name in store.datasets() if name.startswith("blade_")]
        columns = {name.removeprefix("blade_"): data[name] for name in names if name in data}
        return pd.DataFrame(columns, pd.Index(data.get("blade", []), name="blade"))

    def verdict(self, settings: Divergence | None = None) -> Verdict:
        """Judge the growth of the run, and of its longer run if there is one, see `bladerub.study.growth`.

        The status of a run says how its simulation ended, the verdict what its vibration does. A run that is
        ``"unbounded"`` is divergent; one that is ``"completed"`` is divergent, saturating (it grows, but
        levels off) or neither. The verdict, and its own ``status``, are of the longer run if there is one.

        `settings` are ``config.analysis.divergence`` of a study. Default: of its own study, or of the
        study at work (`load_study`) if the run was read from a file.
        """
        longer = self.longer.revolution_amplitude if self.longer else None
        settings = settings or settings_of(None, self.config).analysis.divergence
        return judge(self.revolution_amplitude, self.status, settings, longer)

    def summary(self, config: Config | None = None) -> dict[str, Any]:
        """Summarise the run by the settings of a study `config`, by default as of `verdict`.

        The keys are those of `bladerub.study.summary.summarise`, as in `--json` of `bladerub run`: peak
        amplitude and its engine order, wear, lobes, growth and verdict, steps, status.
        """
        analysis = settings_of(config, self.config).analysis
        return summarise(self.stored, analysis, self.longer.stored if self.longer else None)

    def plot_wear(self, path: str | Path | None = None, *, ax: "Axes | None" = None) -> "Figure | Axes":
        """Draw the worn depth around the casing (mean of the nodes); `path` to write it there as well.

        `ax` are axes to draw into, polar or not, which are returned: one line more for each run.
        """
        return plots.runs.wear(self.angle, self.wear.mean(axis=0), self._title, path=path, ax=ax)

    def plot_history(self, path: str | Path | None = None, *, ax: "Axes | None" = None) -> "Figure | Axes":
        """Draw the radial displacement of node 1 over the run and its amplitude; arguments as `plot_wear`.

        Raises as `radial_displacement`.
        """
        moves = self.stored.data.get("revolution"), self.radial_displacement, self.revolution_amplitude
        return plots.runs.history(*moves, self._title, path=path, ax=ax)

    def plot_spectrum(self, path: str | Path | None = None, *, ax: "Axes | None" = None) -> "Figure | Axes":
        """Draw the amplitude over the engine order; arguments as `plot_wear`."""
        spectrum = self.spectrum
        return plots.runs.spectrum(spectrum.index, spectrum.to_numpy(), self._title, path=path, ax=ax)

    def to_xarray(self) -> "xr.Dataset":
        """Return all datasets with units and names, and the attributes: those of the file of `write`."""
        return to_dataset(*store.joined(runs_of(self)))

    def to_pandas(self) -> pd.DataFrame:
        """Return a row for each revolution: ``revolution_peak`` and ``revolution_amplitude``, m."""
        columns = ("revolution_peak", "revolution_amplitude")
        number = pd.Index(self.stored.data["revolution_number"], name="revolution")
        return pd.DataFrame({name: self.stored.data[name] for name in columns}, number)

    def write(self, path: str | Path, config: Config | None = None) -> None:
        """Write the run to the HDF5 file `path`, whole or not at all; `config` as of `verdict`.

        The names of its longer run, if it has one, begin with ``longer_``. `read_run` returns an equal run.
        Raises OSError, which names the file, if it cannot be written.
        """
        origin = provenance(settings_of(config, self.config).plain())
        hdf5.write(path, *store.joined(runs_of(self)), origin)

    @property
    def _title(self) -> str:
        unit = modulus_unit(self.config) if self.config else None
        return f"{titles.coating(self.case, unit)}, {titles.speed(self.f_omega, self.f1_hz)}"

    def _shown(self) -> tuple[str, Mapping[str, str]]:
        peaks, longer, wear = self.revolution_peak, self.longer, self.wear.max()
        followed = {"followed for": f"{longer.revolutions} revolutions, {longer.status}"} if longer else {}
        return "Run", {
            "coating": self.case.name,
            "speed": speed_in_words(self.f_omega, self.f1_hz),
            "revolutions": f"{self.revolutions}",
            "status": self.status,
            **({"verdict": in_a_word(self.verdict())} if self.config else {}),
            "largest radial displacement": f"{1e3 * displacement_peak(peaks, peaks.size):.4g} mm",
            "greatest wear": f"{1e3 * wear:.4g} mm" + worn_through(wear, self.attributes["layer_thickness"]),
            "energy residual": f"{self.energy.residual:.2g}",
            **followed,
        }


@over("path")
def read_run(path: str | Path) -> Run:
    """Read one run of a study, such as ``results/runs/2nd_E2_K0.5_theta0/0.1900.h5``, or of `Run.write`.

    The longer run is read with it, where there is one. That of a run of a study is the one that the manifest
    of the coating lists or, before the job is done, one that begins as the run. Lists of paths give lists.

    Raises
    ------
    OSError
        If the file is missing, damaged or not a run; the message names it.

    Examples
    --------
    >>> import bladerub as br
    >>> run.write("0.1900.h5", study.config)
    >>> br.read_run("0.1900.h5") == run
    True
    """
    runs = store.read_runs(path)
    if _LONGER not in runs and (longer := _longer_beside(path, runs[""])):
        runs[_LONGER] = longer
    return run_of(runs)


def _longer_beside(path: str | Path, run: store.StoredRun) -> store.StoredRun | None:
    """Read the longer run that the manifest lists; before it lists the run, the one that begins as that."""
    is_listed, longer = lists_longer(path, run.attributes["run_key"]), confirmation_path(path)
    if is_listed or (is_listed is None and longer.exists()):
        stored, peaks = store.read_run(longer), run.data["revolution_peak"]
        if is_listed or np.array_equal(stored.data["revolution_peak"][: peaks.size], peaks):
            return stored
    return None


def runs_of(run: Run, prefix: str = "") -> dict[str, store.StoredRun]:
    """Return what is stored of a run and of its longer one, by what their names in a file begin with."""
    longer = {f"{prefix}{_LONGER}": run.longer.stored} if run.longer else {}
    return {prefix: run.stored} | longer


def run_of(runs: Mapping[str, store.StoredRun], prefix: str = "") -> Run:
    """Return the run whose parts, as of `runs_of`, are among `runs`."""
    stored, longer, module = runs[prefix], runs.get(f"{prefix}{_LONGER}"), stress_measure()
    stress = module.RunStress.described(stored.attributes) if module else None
    return Run(stored, Run(longer) if longer else None, stress)


def to_dataset(variables: Mapping[str, hdf5.Variable], attributes: Mapping[str, Any]) -> "xr.Dataset":
    """Return variables with their units as xarray opens them from a file that holds them."""
    arrays = {
        name: (entry.dims, np.asarray(entry.data), {"units": entry.units, "long_name": entry.long_name})
        for name, entry in variables.items()
    }
    return package("xarray", "xarray").Dataset(arrays, attrs=dict(attributes))


def stress_measure() -> Any:
    """Return the module that finds the stress of the blade; None where the package is without it."""
    place = plugins.offered("MEASURES").get("stress")
    return plugins.load(place) if place else None


def _content(run: Run) -> list[Any]:
    """Return what makes two runs equal: all but the provenance of their files."""
    parts = [
        [prefix, stored.data, {k: v for k, v in stored.attributes.items() if not k.startswith(PREFIX)}]
        for prefix, stored in runs_of(run).items()
    ]
    return [*parts, run.stress]
