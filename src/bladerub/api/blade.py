"""A blade: its reduced model, its mesh, and how well the one follows the other."""

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import pandas as pd
from pydantic import Field

from bladerub import plots
from bladerub.api.arguments import InputError, over
from bladerub.api.display import Shown, step
from bladerub.api.planned import Quantity
from bladerub.api.study import Study
from bladerub.blade.cache import kept_at, rounded_frequency
from bladerub.blade.files import accuracy_path, is_built, mesh_path
from bladerub.blade.frequencies import ACCURACY_COLUMNS, doubts, reduced_frequencies, tip_lean
from bladerub.blade.model import ReducedBlade
from bladerub.blade.validation import read_valid_blade
from bladerub.config.quantities import checked_number
from bladerub.io import tables
from bladerub.io.errors import package
from bladerub.io.provenance import provenance
from bladerub.io.values import equal
from bladerub.settings.fields import Speed
from bladerub.settings.study import Config
from bladerub.settings.units import speed_in_words
from bladerub.study.cache import blade_digest

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FROM_REST = Annotated[Speed, Field(ge=0, le=2)]


@dataclass(frozen=True, repr=False)
class Blade(Shown):
    """A blade, from `build_blade` or `read_blade`.

    Parameters
    ----------
    reduced : ReducedBlade
        The reduced model, eqs. (2) to (6): matrices, interface nodes, speed law. SI units.
    path : Path
        Its file. Next to it are ``mesh.h5`` and ``rom_accuracy.csv``.

    Examples
    --------
    >>> round(blade.length, 3), 190 < blade.f1_hz < 200  # m, Hz
    (0.2, True)
    >>> blade.tip_lean.shape, bool(blade.tip_lean.max() < 0)
    ((8,), True)
    >>> blade.frequencies(f_omega=0.3).shape
    (3,)
    >>> 0.18 < blade.f_omega("2200 rpm") < 0.2
    True
    >>> blade.check_speed("f_omega", 0.39)
    >>> float(blade.accuracy()["f_omega"].max())
    0.4
    >>> blade.doubts()
    []
    >>> blade.to_xarray()["mass"].units
    'kg'
    >>> blade.mesh_path.name, len(blade.digest)
    ('mesh.h5', 64)
    >>> figure = blade.plot_campbell("campbell.png")
    >>> figure = blade.plot_mesh("blade.png")
    """

    reduced: ReducedBlade = field(repr=False, hash=False)
    path: Path

    def __eq__(self, other: object) -> bool:
        # a reduced model equals itself alone, so that what follows from it can be cached
        if not isinstance(other, Blade):
            return NotImplemented
        a, b = self.reduced, other.reduced
        return self.path == other.path and equal(a.arrays, b.arrays) and a.attributes == b.attributes

    @property
    def f1_hz(self) -> float:
        """First eigenfrequency at rest, Hz; the unit of all normalised frequencies."""
        return self.reduced.f1_hz

    @property
    def length(self) -> float:
        """Blade length, m; the unit of clearances in a config."""
        return self.reduced.length

    @cached_property
    def tip_lean(self) -> np.ndarray:
        """Radial over tangential displacement (8,) of the tip in mode 1, leading to trailing edge.

        Negative where bending with the rotation moves the tip away from the casing.
        """
        return tip_lean(self.reduced)

    @cached_property
    def digest(self) -> str:
        """Digest of the reduced model: what it has in the keys of runs."""
        return blade_digest(self.path)

    @property
    def mesh_path(self) -> Path:
        """File of the mesh that belongs to the reduced model."""
        return mesh_path(self.path)

    @over("speed")
    def f_omega(self, speed: Quantity) -> float:
        """Normalise a speed with a unit, such as ``"2200 rpm"``; one that is a number is normalised already.

        A list of speeds gives a list. One with a unit is rounded to six decimals, as those of a study. Raises
        `InputError` if one is no speed.
        """
        try:
            return checked_number("f_omega", speed, _FROM_REST, lambda _: rounded_frequency(self.f1_hz))
        except ValueError as error:
            raise InputError("speed", speed, str(error)) from None

    def check_speed(self, name: str, f_omega: float, f1_hz: float | None = None) -> None:
        """Check that the reduced model holds at the normalised speed `f_omega`, the argument `name`.

        `f1_hz` is the first frequency by which a speed with a unit was normalised, Hz. Raises `InputError`,
        which says up to which speed the model holds, if not, or if the frequency is that of another blade.
        """
        if f1_hz and not math.isclose(f1_hz, self.f1_hz, rel_tol=1e-6):
            rpm = f"{60 * f_omega * f1_hz:.0f} rpm"
            raise InputError(name, f_omega, f'is {rpm} of another blade, must be blade.f_omega("{rpm}")')
        if f_omega > self.reduced.f_omega_max:
            fastest = speed_in_words(self.reduced.f_omega_max, self.f1_hz)
            raise InputError(name, f_omega, f"must be at most reduction.f_omega_max of this blade, {fastest}")

    def frequencies(self, f_omega: Quantity | Sequence[Quantity] = 0.0, n_modes: int = 3) -> np.ndarray:
        """Lowest eigenfrequencies (n_modes,) of the reduced model at a speed as of `Blade.f_omega`, Hz.

        At n speeds they are (n, n_modes). Raises `InputError` if one is outside the range of the blade.
        """
        if not isinstance(f_omega, float | int | str | np.number):
            return np.stack([self.frequencies(speed, n_modes) for speed in f_omega])
        speed = self.f_omega(f_omega)
        self.check_speed("f_omega", speed)
        if n_modes not in range(1, len(self.reduced.mass) + 1):
            raise InputError("n_modes", n_modes, f"must be a whole number from 1 to {len(self.reduced.mass)}")
        return reduced_frequencies(self.reduced, speed, n_modes)

    def accuracy(self) -> pd.DataFrame:
        """Frequencies (Hz) of finite elements, eq. (2) and reduced model, as in ``rom_accuracy.csv``.

        Raises OSError, which names the table, if it is missing, as for a blade read from elsewhere.
        """
        return tables.read(accuracy_path(self.path), ACCURACY_COLUMNS)

    def doubts(self, nominal_speed: float | None = None) -> list[str]:
        """Name what makes its frequencies doubtful, with the cure: a line each, none for a sound blade.

        `nominal_speed` is that of its rotor, 1/min, if it is known. Raises as `accuracy`.
        """
        return doubts(self.accuracy(), nominal_speed)

    def plot_mesh(self, path: str | Path | None = None, *, ax: "Axes | None" = None) -> "Figure | Axes":
        """Draw Fig. 1: mesh, clamped root and interface nodes.

        `path` is to write it there as well. In the axes `ax`, which are returned, is the mesh as a whole.
        """
        return plots.blade_mesh.blade_mesh(self.mesh_path, path=path, ax=ax)

    def plot_campbell(self, path: str | Path | None = None, *, ax: "Axes | None" = None) -> "Figure | Axes":
        """Draw Fig. 2: the Campbell diagram; `path` as `plot_mesh`. Raises as `accuracy`.

        In the axes `ax`, which are returned, are the first mode and the engine orders.
        """
        scales = plots.scales.Scales(f1_hz=self.f1_hz)
        return plots.campbell.campbell(self.accuracy(), scales, path=path, ax=ax)

    def to_xarray(self) -> "xr.Dataset":
        """Return matrices, interface nodes and directions with units and names."""
        return package("xarray", "xarray").load_dataset(self.path, engine="h5netcdf", phony_dims="sort")

    def _shown(self) -> tuple[str, Mapping[str, str]]:
        return "Blade", {
            "first eigenfrequency at rest": f"{self.f1_hz:.5g} Hz",
            "u_r/u_t of mode 1 at the tip": f"{self.tip_lean[0]:.3f} to {self.tip_lean[-1]:.3f}",
            "length": f"{1e3 * self.length:.4g} mm",
            "coordinates": f"{len(self.reduced.mass)}",
            "highest speed": speed_in_words(self.reduced.f_omega_max, self.f1_hz),
            "file": f"{self.path}",
        }


def read_blade(path: str | Path) -> Blade:
    """Read a reduced blade, such as ``results/blade/reduced_model.h5``.

    Raises
    ------
    OSError
        If the file is missing or damaged; the message names it.
    ValueError
        If it holds no valid reduced blade.

    Examples
    --------
    >>> import bladerub as br
    >>> br.read_blade(blade.path) == blade
    True
    """
    path = Path(path)
    return Blade(read_valid_blade(path), path)


def build_blade(study: Study, progress: bool | None = None) -> Blade:
    """Build the blade of a study, or read it where it is built already.

    A blade of the same config is looked for in the results of the study, then in the cache
    (`bladerub.io.folders.cache_folder`), where a new one is kept. `progress` is as of `simulate`.

    Warns
    -----
    UserWarning
        For each of the blade's `Blade.doubts`: eq. (2) or the reduction is not accurate, for instance.

    Raises
    ------
    BadInput
        If the config's blade cannot be built or imported; the message says what would be right.
    ValueError
        If it cannot be meshed.

    Examples
    --------
    >>> import bladerub as br
    >>> br.build_blade(study) == blade
    True
    """
    if not isinstance(study, Study):
        raise InputError("study", study, "must be a Study, as of load_study")
    of_study = study.results / "blade" / "reduced_model.h5"
    path = of_study if is_built(study.config, of_study) else kept_at(study.config)
    if not is_built(study.config, path):
        with step("building the blade", progress):
            write_blade(study.config, path)
    blade = read_blade(path)
    for line in blade.doubts(study.config.figures.nominal_speed):
        warnings.warn(line, stacklevel=2)
    return blade


def write_blade(config: Config, path: Path) -> None:
    """Build the blade of `config` and write it to `path`, its mesh and table of accuracy next to it."""
    # they import scikit-fem and the solver, which a blade that is built already does without
    from bladerub.blade.build import build
    from bladerub.blade.built import write

    write(build(config), provenance(config.plain()), path)
