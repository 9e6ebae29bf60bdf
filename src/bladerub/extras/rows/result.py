"""What a run of a row of blades gives, in SI units."""

from dataclasses import dataclass, fields, replace

import numpy as np

from bladerub.contact.result import Energy, RunResult


@dataclass(frozen=True)
class RowResult:
    """Outcome of a run of a row.

    Parameters
    ----------
    status, message : str
        As of `Outcome`, for the whole row.
    angle : (n_elements,) ndarray
        Casing angle of the element centres, rad.
    wear : (8, n_elements) ndarray
        Permanent shortening of each element under each node by all blades, m.
    blades : tuple of RunResult
        Outcome of each blade, in the order of the row. Revolutions are counted from the start of the row, the
        wear is that of all. The energy ledger of a blade lacks the work of the disk.
    worn_volume : (n_blades,) ndarray
        Volume that each blade has worn off, m³.
    unbounded : tuple of int
        Numbers of the blades, counted from 1, that left the displacement limit.
    disk_work : (n_blades,) ndarray
        Work of the disk on each blade, J.
    disk_energy : float
        Elastic energy that the disk has taken up since the start, J.
    """

    status: str
    message: str
    angle: np.ndarray
    wear: np.ndarray
    blades: tuple[RunResult, ...]
    worn_volume: np.ndarray
    unbounded: tuple[int, ...]
    disk_work: np.ndarray
    disk_energy: float

    @property
    def energy(self) -> Energy:
        """The ledgers of all blades together."""
        ledgers = [blade.energy for blade in self.blades]
        return Energy(
            **{entry.name: sum(getattr(ledger, entry.name) for ledger in ledgers) for entry in fields(Energy)}
        )

    @property
    def residual(self) -> float:
        """What the ledger of all blades, coating and disk misses, over the work exchanged in the contact."""
        total = self.energy
        return replace(total, elastic=total.elastic + self.disk_energy).residual
