"""A map: all runs of one coating over the speed."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from bladerub import plots
from bladerub.api.arguments import InputError, over
from bladerub.api.blade import Blade
from bladerub.api.display import Shown
from bladerub.api.planned import Quantity, StudyCoating
from bladerub.api.run import to_dataset
from bladerub.api.study import settings_of
from bladerub.extras.many_runs import solve_all
from bladerub.io.hdf5 import read_attributes
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.settings.units import speeds_in_words
from bladerub.study import maps
from bladerub.study.divergence import in_a_word, verdicts
from bladerub.study.grid import CoatingCase, modulus_unit
from bladerub.study.maps import CoatingMap
from bladerub.study.summary import spectral_peak

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from bladerub.plots.scales import Scales

_PER_SPEED = ("C1", "max_wear", "lobes", "status", "wear_harmonic", "wear_harmonic_share")
_PER_REVOLUTION = ("revolution_peak", "revolution_amplitude")


@dataclass(frozen=True, repr=False)
class Map(Shown):
    """Wear and spectra of one coating over the speed, from `simulate_speeds` or `read_map`.

    Parameters
    ----------
    coating : CoatingMap
        The arrays: `bladerub.study.maps.DATASETS` has dimensions, unit and meaning of each. SI units,
        speeds normalised.
    f1_hz : float, optional
        First frequency of the blade at rest, Hz, for what is shown in rpm and Hz.
    config : Config, optional
        That of its study, if it was simulated here.

    Examples
    --------
    >>> sweep.case.name, sweep.f_omega.tolist(), sweep.status.tolist()
    ('2nd_E2_K0.5_theta0', [0.19, 0.2], ['completed', 'completed'])
    >>> sweep.wear.shape
    (2, 2000)
    >>> list(sweep.to_pandas().index)
    [0.19, 0.2]
    >>> sweep.to_xarray()["wear"].units
    'm'
    >>> sweep.write("map.h5", study.config)
    >>> br.read_map("map.h5") == sweep
    True
    >>> figure = sweep.plot_wear("map.png")
    >>> figure = sweep.plot_spectrum("spectrum.png")
    """

    coating: CoatingMap
    f1_hz: float | None = field(default=None, compare=False)
    config: Config | None = field(default=None, compare=False)

    @property
    def case(self) -> CoatingCase:
        """Casing, coating and law of friction, normalised."""
        return self.coating.case

    @property
    def f_omega(self) -> np.ndarray:
        """Speeds (n,), ascending, normalised."""
        return self.coating.f_omega

    @property
    def wear(self) -> np.ndarray:
        """Worn depth (n, elements), mean over the interface nodes, m."""
        return self.coating.wear

    @property
    def status(self) -> np.ndarray:
        """``"completed"`` or ``"unbounded"`` of each run (n,)."""
        return self.coating.status

    def plot_wear(self, path: str | Path | None = None, *, ax: "Axes | None" = None) -> "Figure | Axes":
        """Draw the wear around the casing over the speed (Fig. 6); `path` to write it there as well.

        In the axes `ax`, which are returned, is the wear without the number of lobes.
        """
        return plots.wear_map.wear_map(self.coating, self._scales, path=path, ax=ax)

    def plot_spectrum(
        self,
        path: str | Path | None = None,
        amplitude_range: tuple[float, float] | None = None,
        max_frequency: float = 2.0,
        *,
        ax: "Axes | None" = None,
    ) -> "Figure | Axes":
        """Draw the spectra over the speed (Figs. 7 to 9); `path` and `ax` as `plot_wear`.

        `amplitude_range` are the ends of the colour scale, m (default: three decades up to the largest
        amplitude); `max_frequency` is the right end of the axis, normalised. Raises `InputError` if either
        is not possible.
        """
        largest = plots.scales.greatest(self.coating.spectrum_amplitude)
        ends = (1e-3 * largest, largest) if amplitude_range is None else amplitude_range
        if amplitude_range is not None and not (np.shape(ends) == (2,) and _ascend(*ends)):
            raise InputError("amplitude_range", ends, "must be two lengths above 0, ascending, in m")
        if not _ascend(max_frequency):
            raise InputError("max_frequency", max_frequency, "must be a number above 0")
        return plots.spectrum.spectrum_map(self.coating, ends, max_frequency, self._scales, path=path, ax=ax)

    def to_xarray(self) -> "xr.Dataset":
        """Return all arrays with coordinates, units and names."""
        return to_dataset(maps.variables(self.coating), asdict(self.case))

    def to_pandas(self, config: Config | None = None) -> pd.DataFrame:
        """Return a row for each speed, judged by the settings of a `config` as of `Run.verdict`.

        Columns: ``rpm`` (NaN where the blade is not known), ``C1`` (first eigenfrequency, normalised),
        ``max_wear`` (worn depth, m), ``lobes``, ``status``, ``wear_harmonic`` and ``wear_harmonic_share``
        (`bladerub.study.wear.dominant_harmonic`), ``revolution_peak`` and ``revolution_amplitude`` of the
        last revolution (m), ``engine_order`` and ``spectral_peak`` (m) of the largest amplitude of the
        spectrum above order 0.5, ``growth_per_revolution`` (0.03 is 3 %) and ``verdict``
        (`bladerub.study.divergence.in_a_word`).
        """
        coating, judged = self.coating, verdicts(settings_of(config, self.config), self.coating)
        spectra = coating.spectrum_amplitude
        peaks = np.array([spectral_peak(coating.spectrum_order, spectrum) for spectrum in spectra])
        columns = {
            "rpm": 60 * (self.f1_hz or np.nan) * self.f_omega,
            **{name: getattr(coating, name) for name in _PER_SPEED},
            **{name: getattr(coating, name)[:, -1] for name in _PER_REVOLUTION},
            "engine_order": np.where(peaks[:, 1] > 0, peaks[:, 0], np.nan),
            "spectral_peak": peaks[:, 1],
            "growth_per_revolution": [verdict.growth.per_revolution for verdict in judged],
            "verdict": [in_a_word(verdict) for verdict in judged],
        }
        return pd.DataFrame(columns, index=pd.Index(self.f_omega, name="f_omega"))

    def write(self, path: str | Path, config: Config | None = None) -> None:
        """Write the map to the HDF5 file `path`, whole or not at all; `config` as of `Run.verdict`.

        Raises OSError, which names the file, if it cannot be written.
        """
        maps.write_map(path, self.coating, provenance(settings_of(config, self.config).plain()))

    @property
    def _scales(self) -> "Scales":
        unit = modulus_unit(self.config) if self.config else None
        return plots.scales.Scales(modulus_unit=unit, f1_hz=self.f1_hz)

    def _shown(self) -> tuple[str, Mapping[str, str]]:
        return "Map", {
            "coating": self.case.name,
            "speeds": speeds_in_words(self.f_omega.tolist(), self.f1_hz),
            "greatest wear": f"{1e3 * self.coating.max_wear.max():.4g} mm",
            "unbounded": f"{np.count_nonzero(self.status != 'completed')}",
        }


def _ascend(*numbers: Any) -> bool:
    """Return whether these are finite numbers above 0, each above the one before it."""
    are_numbers = all(isinstance(number, int | float | np.number) for number in numbers)
    return are_numbers and all(low < high for low, high in pairwise([0.0, *numbers, np.inf]))


@over("path")
def read_map(path: str | Path) -> Map:
    """Read the map of one coating, such as ``results/maps/2nd_E2_K0.5_theta0.h5``.

    Its first frequency is that of the blade of the same results, if there is one.

    Raises
    ------
    OSError
        If the file is missing, damaged or not a map; the message names it.

    Examples
    --------
    >>> import bladerub as br
    >>> sweep.write("2nd_E2_K0.5_theta0.h5", study.config)
    >>> br.read_map("2nd_E2_K0.5_theta0.h5").case.name
    '2nd_E2_K0.5_theta0'
    """
    blade = Path(path).absolute().parent.parent / "blade" / "reduced_model.h5"
    f1_hz = None
    with suppress(OSError, KeyError):
        f1_hz = float(read_attributes(blade)["f1_hz"])
    return Map(maps.read_map(path, with_nodes=True), f1_hz)


@over("coating")
def simulate_speeds(
    blade: Blade,
    coating: StudyCoating,
    speeds: Iterable[Quantity],
    *,
    jobs: int = 1,
    follow: bool = True,
    progress: bool | None = None,
) -> Map:
    """Simulate one coating at many speeds.

    Parameters
    ----------
    blade : Blade
        The blade.
    coating : StudyCoating
        The coating, from `Study.coating` or `Study.rigid`; a list of them gives a list of maps.
    speeds : iterable of float or str
        Speeds, normalised or with a unit (``"2200 rpm"``, of this blade): two or more, ascending in the map.
    jobs : int
        Runs at once.
    follow, progress : bool, optional
        As of `simulate`.

    Raises
    ------
    InputError
        If a speed is outside the range of the blade, or there are fewer than two.

    Examples
    --------
    >>> import bladerub as br
    >>> coating = study.coating("2nd", E=2, K=0.5)
    >>> sweep = br.simulate_speeds(blade, coating, [0.19, 0.2], jobs=2, progress=False)
    >>> sweep.status.tolist()
    ['completed', 'completed']
    """
    speeds = np.ravel(speeds).tolist() if isinstance(speeds, np.ndarray) else speeds
    speeds = [speeds] if isinstance(speeds, float | int | str) else speeds
    runs = [coating.at(f_omega) for f_omega in sorted({blade.f_omega(speed) for speed in speeds})]
    if len(runs) < 2:
        raise InputError("speeds", [run.f_omega for run in runs], "must be two or more different ones")
    blade.check_speed("speeds", runs[-1].f_omega)
    results, f_omega = solve_all(blade, runs, jobs, follow, progress), [run.f_omega for run in runs]
    stored = [run.stored for run in results]
    longer = [run.longer.stored if run.longer else None for run in results]
    collected = maps.collect(coating.config, coating.case, blade.reduced, f_omega, stored, longer)
    return Map(collected, blade.f1_hz, coating.config)
