"""What a row of blades is: what distinguishes its blades, and the disk between them."""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any, Self

import numpy as np


@dataclass(frozen=True)
class RowBlade:
    """One blade of a row, by what distinguishes it.

    Parameters
    ----------
    angle : float
        Angle by which it is ahead of the start of the run in rotation, rad.
    length : float
        Tip radius beyond the nominal one, m.
    frequency : float or tuple of float
        Relative deviation of its natural frequencies: one for all modes, or one for each of the first ones,
        and none for the others. Its mode shapes are those of the nominal blade.
    damping : float
        Its damping ratio over that of the run.

    Examples
    --------
    >>> import bladerub as br
    >>> longer = br.RowBlade(angle=3.1416, length=5e-5, frequency=(0.01, -0.01))
    >>> longer.frequency_factors(3).tolist()
    [1.01, 0.99, 1.0]
    """

    angle: float
    length: float = 0.0
    frequency: float | tuple[float, ...] = 0.0
    damping: float = 1.0

    def frequency_factors(self, n_modes: int) -> np.ndarray:
        """Natural frequencies (n_modes,) over those of the nominal blade."""
        factors = np.ones(n_modes)
        if isinstance(self.frequency, tuple):
            deviations = self.frequency[:n_modes]
            factors[: len(deviations)] += deviations
        else:
            factors += self.frequency
        return factors


@dataclass(frozen=True)
class Disk:
    """Elastic coupling of the N blades of a row by the disk, mode by mode.

    The equations of motion in mode m of all blades are
    ``q̈_b + 2 ξ ω_b q̇_b + ω_b² q_b + ω_m² Σ_c S_bc q_c = p_b``, ω_m that of the nominal blade.

    Parameters
    ----------
    stiffness : tuple of tuple of tuple of float
        A symmetric matrix S (N, N) for each of the first modes; the others are not coupled.

    Examples
    --------
    >>> import bladerub as br
    >>> disk = br.Disk.ring(4, [0.01])
    >>> disk.stiffness[0][0]
    (0.02, -0.01, 0.0, -0.01)
    >>> br.Disk.of([[[0.02, -0.02], [-0.02, 0.02]]]).stiffness[0][0]
    (0.02, -0.02)
    """

    stiffness: tuple[tuple[tuple[float, ...], ...], ...]

    @classmethod
    def ring(cls, n_blades: int, coupling: Sequence[float]) -> Self:
        """Describe equal springs between neighbours, those of mode m ``coupling[m]`` times as stiff as it.

        Identical blades then have the frequencies ``ω_m √(1 + 4 c_m sin²(π n / N))`` for n nodal diameters.
        """
        link = np.eye(n_blades) - np.roll(np.eye(n_blades), 1, axis=1)
        return cls.of([c * (link.T @ link) for c in coupling])

    @classmethod
    def of(cls, matrices: Iterable[np.ndarray]) -> Self:
        """Describe the coupling by a matrix (N, N) for each of the first modes."""
        return cls(tuple(tuple(map(tuple, np.asarray(matrix, dtype=float).tolist())) for matrix in matrices))


@dataclass(frozen=True)
class Row:
    """The blades of a row, in any order, and the disk that couples them, if any does.

    Raises
    ------
    ValueError
        If there is no blade, a value is not a finite number in its range, or the disk has a matrix of another
        size or one that is not symmetric.

    Examples
    --------
    >>> import bladerub as br
    >>> row = br.Row.even(3, length=[0.0, 5e-5, 0.0], disk=br.Disk.ring(3, [0.01]))
    >>> row.blades[1].length
    5e-05
    >>> drawn = br.Row.drawn(12, seed=1, length_scatter=2e-5, frequency_scatter=0.005)
    >>> len(drawn.blades), drawn == br.Row.drawn(12, seed=1, length_scatter=2e-5, frequency_scatter=0.005)
    (12, True)
    >>> br.Row.from_json(row.to_json()) == row
    True
    """

    blades: tuple[RowBlade, ...]
    disk: Disk | None = None

    def __post_init__(self) -> None:
        if not self.blades:
            raise ValueError("row: no blades; must have one or more")
        for number, blade in enumerate(self.blades, 1):
            for name, value in vars(blade).items():
                if not np.all(np.isfinite(value)):
                    raise ValueError(f"row, blade {number}: {name} = {value}; must be a finite number")
            if np.any(np.asarray(blade.frequency) <= -1):
                raise ValueError(f"row, blade {number}: frequency = {blade.frequency}; must be above -1")
            if blade.damping < 0:
                raise ValueError(f"row, blade {number}: damping = {blade.damping:g}; must not be negative")
        n_blades = len(self.blades)
        for mode, matrix in enumerate(self.disk.stiffness if self.disk else (), 1):
            values = np.array(matrix)
            if values.shape != (n_blades, n_blades):
                raise ValueError(
                    f"row, disk, mode {mode}: a matrix of shape {values.shape}; must be one row and one "
                    f"column for each of the {n_blades} blades"
                )
            if not (np.isfinite(values).all() and np.allclose(values, values.T, rtol=1e-9, atol=0)):
                raise ValueError(f"row, disk, mode {mode}: must be a symmetric matrix of finite numbers")

    def to_json(self) -> str:
        """Describe the row by JSON, for `from_json`."""
        return json.dumps(asdict(self), sort_keys=True)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Read what `to_json` wrote; raises `KeyError`, `TypeError` or `ValueError` on anything else."""
        document = json.loads(text)
        for entry in document["blades"]:
            if isinstance(entry["frequency"], list):
                entry["frequency"] = tuple(entry["frequency"])
        blades = tuple(RowBlade(**entry) for entry in document["blades"])
        return cls(blades, document["disk"] and Disk.of(document["disk"]["stiffness"]))

    @classmethod
    def even(
        cls,
        n_blades: int,
        length: float | Iterable[float] = 0.0,
        frequency: float | Iterable[float] | np.ndarray = 0.0,
        damping: float | Iterable[float] = 1.0,
        angle_error: float | Iterable[float] = 0.0,
        disk: Disk | None = None,
    ) -> Self:
        """Describe blades at even angles, each value one for all of them or one for each.

        `frequency` may also be (n_blades, n): the deviation of each of the first n modes. Raises `ValueError`
        if the number of values is not that of the blades.
        """
        if n_blades < 1:
            raise ValueError(f"row: {n_blades} blades; must have one or more")
        inputs = {"angle_error": angle_error, "length": length, "frequency": frequency, "damping": damping}
        values: dict[str, list[Any]] = {}
        for name, value in inputs.items():
            array = np.atleast_1d(np.asarray(value, dtype=float))
            if len(array) not in (1, n_blades) or array.ndim > (2 if name == "frequency" else 1):
                shape = " x ".join(map(str, array.shape))
                raise ValueError(f"row: {shape} values of {name}; must be 1 or {n_blades}")
            array = np.broadcast_to(array, (n_blades, *array.shape[1:]))
            values[name] = [tuple(entry) if isinstance(entry, list) else entry for entry in array.tolist()]
        errors = values.pop("angle_error")
        angles = [2 * np.pi * index / n_blades + error for index, error in enumerate(errors)]
        return cls(tuple(map(RowBlade, angles, *values.values())), disk)

    @classmethod
    def drawn(
        cls,
        n_blades: int,
        seed: int,
        length_scatter: float = 0.0,
        frequency_scatter: float = 0.0,
        disk: Disk | None = None,
    ) -> Self:
        """Draw blades at even angles, whose tip radii and frequencies are normally distributed.

        The scatters are standard deviations, of the length in m. The draws of a `seed` are those of all
        scatters: twice the scatter gives twice the deviations. Raises `ValueError` if a value is not in its
        range.
        """
        for name, scatter in (("length_scatter", length_scatter), ("frequency_scatter", frequency_scatter)):
            if not (np.isfinite(scatter) and scatter >= 0):
                raise ValueError(f"row: {name} = {scatter:g}; must be a finite number, 0 or more")
        length, frequency = np.random.default_rng(seed).standard_normal((2, max(n_blades, 0)))
        lengths, frequencies = length_scatter * length, frequency_scatter * frequency
        return cls.even(n_blades, lengths + 0.0, frequencies + 0.0, disk=disk)  # no -0
