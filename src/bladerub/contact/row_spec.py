"""What distinguishes the blades of a row."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

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
    frequency : float
        Relative deviation of its natural frequencies; its mode shapes are those of the others.
    damping : float
        Its damping ratio over that of the run.
    """

    angle: float
    length: float = 0.0
    frequency: float = 0.0
    damping: float = 1.0


@dataclass(frozen=True)
class Row:
    """The blades of a row, in any order.

    Raises `ValueError` if there is none, or a value is not a finite number in its range.
    """

    blades: tuple[RowBlade, ...]

    def __post_init__(self) -> None:
        if not self.blades:
            raise ValueError("row: no blades; must have one or more")
        for number, blade in enumerate(self.blades, 1):
            for name, value in vars(blade).items():
                if not np.isfinite(value):
                    raise ValueError(f"row, blade {number}: {name} = {value}; must be a finite number")
            if blade.frequency <= -1:
                raise ValueError(f"row, blade {number}: frequency = {blade.frequency:g}; must be above -1")
            if blade.damping < 0:
                raise ValueError(f"row, blade {number}: damping = {blade.damping:g}; must not be negative")

    @classmethod
    def even(
        cls,
        n_blades: int,
        length: float | Iterable[float] = 0.0,
        frequency: float | Iterable[float] = 0.0,
        damping: float | Iterable[float] = 1.0,
        angle_error: float | Iterable[float] = 0.0,
    ) -> Self:
        """Describe blades at even angles, each value one for all of them or one for each.

        Raises `ValueError` if the number of values is not that of the blades.
        """
        if n_blades < 1:
            raise ValueError(f"row: {n_blades} blades; must have one or more")
        given = {"angle_error": angle_error, "length": length, "frequency": frequency, "damping": damping}
        values = {}
        for name, value in given.items():
            listed = np.ravel(np.asarray(value, dtype=float))
            if listed.size not in (1, n_blades):
                raise ValueError(f"row: {listed.size} values of {name}; must be 1 or {n_blades}")
            values[name] = np.broadcast_to(listed, n_blades).tolist()
        error = values.pop("angle_error")
        return cls(
            tuple(
                RowBlade(2 * np.pi * at / n_blades + error[at], *(each[at] for each in values.values()))
                for at in range(n_blades)
            )
        )
