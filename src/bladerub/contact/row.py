"""A row of blades that rub on one coating: `RunSpec` and `Row` → `RowResult`.

1. The disk is stiff: each blade vibrates by itself, as in `bladerub.contact.run`. The blades share the
   coating: what one has worn is missing when the next one comes.
2. All blades follow the same casing at the same speed, each from its angle on the disk. The casing distorts
   at the start of the run. A blade that would overlap with it there is held until it first passes a place
   where it touches nothing at rest.
3. An element is under one blade at a time, since neighbours stand further apart than the displacement limit
   lets them reach. So the order in which they pass an element is known beforehand, and each blade can be
   integrated over many elements at once, as far as the one ahead has left the coating behind it
   (`bladerub.contact.front`).
4. The run ends for all blades in the element in which the first of them leaves the displacement limit.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.front import Front
from bladerub.contact.result import Energy, RunResult
from bladerub.contact.row_spec import Row
from bladerub.contact.spec import RunSpec


@dataclass(frozen=True)
class RowResult:
    """Outcome of a run of a row.

    Parameters
    ----------
    status, message : str
        As of `bladerub.contact.result.Outcome`, for the whole row.
    angle : (n_elements,) ndarray
        Casing angle of the element centres, rad.
    wear : (8, n_elements) ndarray
        Permanent shortening of each element under each node by all blades, m.
    blades : tuple of RunResult
        Outcome of each blade, in the order of the row. Revolutions are counted from the start of the row, the
        wear is that of all.
    worn_volume : (n_blades,) ndarray
        Volume that each blade has worn off, m³.
    unbounded : tuple of int
        Numbers of the blades, counted from 1, that left the displacement limit.
    """

    status: str
    message: str
    angle: np.ndarray
    wear: np.ndarray
    blades: tuple[RunResult, ...]
    worn_volume: np.ndarray
    unbounded: tuple[int, ...]

    @property
    def energy(self) -> Energy:
        """The ledgers of all blades together."""
        ledgers = [blade.energy for blade in self.blades]
        return Energy(**{each.name: sum(getattr(of, each.name) for of in ledgers) for each in fields(Energy)})


@threadpool_limits.wrap(limits=1, user_api="blas")  # sums depend on the number of threads
def simulate_row(
    blade: ReducedBlade, spec: RunSpec, row: Row, progress: Callable[[int], None] | None = None
) -> RowResult:
    """Simulate the contact of a row of blades with one coating at one constant speed.

    Parameters
    ----------
    blade : ReducedBlade
        The nominal blade.
    spec : RunSpec
        Stator, speed and length of the run. A row of one nominal blade at angle 0 makes the run of
        `bladerub.contact.run.simulate`, to the last bit.
    row : Row
        The blades.
    progress : callable, optional
        Called with the number of revolutions that all blades have done.

    Raises
    ------
    ValueError
        As `simulate`; and if neighbours are so close that they could meet, or a blade so long that it
        touches all around the casing.
    """
    front = Front(blade, spec, row.blades)
    left = front.march(spec.revolutions * spec.coating.n_elements, progress)
    if left is not None and len(row.blades) > 1:
        # blades ahead of that moment have worn the coating already: again, to the end of that element
        front = Front(blade, spec, row.blades)
        front.march(left + 1)
    results = front.results()
    unbounded = tuple(number for number, each in enumerate(results, 1) if each.status == "unbounded")
    status, message = results[0].status, results[0].message
    if unbounded:
        status, message = "unbounded", f"blade {unbounded[0]}: {results[unbounded[0] - 1].message}"
    return RowResult(
        status, message, results[0].angle, results[0].wear, results, front.worn_volume(), unbounded
    )
