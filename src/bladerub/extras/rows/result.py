"""What a run of a row of blades gives, in SI units."""

from dataclasses import dataclass, fields, replace

import numpy as np

from bladerub.contact.result import Energy, RunResult


@dataclass(frozen=True)
class RowResult:
    """Outcome of a run of a row.

    Of each blade revolutions are counted from the start of the row, the wear is that of all, and the energy
    ledger lacks the work of the disk.
    """

    status: str  # as of `Outcome`, for the whole row
    message: str
    angle: np.ndarray  # (n_elements,), casing angle of the element centres, rad
    wear: np.ndarray  # (8, n_elements), permanent shortening under each node by all blades, m
    blades: tuple[RunResult, ...]  # in the order of the row
    worn_volume: np.ndarray  # (n_blades,), that each has worn off, m³
    unbounded: tuple[int, ...]  # numbers, counted from 1, of the blades that left the displacement limit
    disk_work: np.ndarray  # (n_blades,), on each blade, J
    disk_energy: float  # elastic, that the disk has taken up since the start, J

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
