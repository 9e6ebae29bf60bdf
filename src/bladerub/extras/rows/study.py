"""Rows of blades as runs of a study (`bladerub.study.solver`)."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.spec import RunSpec
from bladerub.extras.rows.result import RowResult
from bladerub.extras.rows.spec import Disk, Row
from bladerub.io import sources
from bladerub.settings.analysis import Analysis
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase
from bladerub.study.store import StoredRun, stored_run


def described(config: Config) -> Row:
    """Describe the row that the block ``rotor`` of the study `config` is of.

    Raises `ValueError` if a list has neither one value nor one for each blade.
    """
    rotor = config.rotor
    scatters = rotor.length_scatter or 0.0, rotor.frequency_scatter or 0.0
    drawn = Row.drawn(rotor.blades, 1 if rotor.seed is None else rotor.seed, *scatters).blades
    row = Row.even(
        rotor.blades,
        length=rotor.length or 0.0,
        frequency=rotor.frequency or 0.0,
        angle_error=rotor.angle_error or 0.0,
        damping=rotor.damping or 1.0,
        disk=Disk.ring(rotor.blades, rotor.coupling) if rotor.coupling else None,
    )
    blades = (
        replace(blade, length=blade.length + draw.length, frequency=blade.frequency + draw.frequency)
        for blade, draw in zip(row.blades, drawn, strict=True)
    )
    return replace(row, blades=tuple(blades))


def drawn(n_blades: int, seed: int, coupling: float = 0.0, **scatters: float) -> Row:
    """Draw a row as `Row.drawn`, on a disk that couples the first mode if `coupling` is not 0."""
    disk = Disk.ring(n_blades, [coupling]) if coupling else None
    return Row.drawn(n_blades, seed, **scatters, disk=disk)


def stored(run: StoredRun) -> Row | None:
    """Return the row that a run was of; None for a single blade."""
    return Row.from_json(str(run.data["row"])) if "row" in run.data else None


def determinants(row: Row) -> dict[str, Any]:
    """Return what determines a run of `row` besides what determines one of a single blade."""
    return {"row": row, "rows": rows_digest()}


@cache
def rows_digest() -> str:
    """Digest the source of what computes and stores rows."""
    return sources.source_digest((sources.PACKAGE / "extras" / "rows").glob("*.py"))


def compute(
    row: Row,
    blade: ReducedBlade,
    case: CoatingCase,
    spec: RunSpec,
    key: str,
    analysis: Analysis,
    keep_history: bool,
    progress: Callable[[int], None] | None = None,
) -> StoredRun:
    """Simulate a row, and return what is stored of it.

    It is the run of the blade that vibrates most, whose number is the attribute ``blade``, with the energy of
    the whole row and what `bladerub.extras.rows.datasets` describes. Other parameters are those of
    `bladerub.study.job.compute`. Raises `ValueError` as `bladerub.extras.rows.row.simulate_row`.
    """
    from bladerub.extras.rows.row import simulate_row  # loads the compiler: who plans runs alone does without

    outcome = simulate_row(blade, spec, row, progress)
    return _stored(case, spec, row, outcome, key, analysis, keep_history)


def _stored(
    case: CoatingCase,
    spec: RunSpec,
    row: Row,
    result: RowResult,
    run_key: str,
    analysis: Analysis,
    keep_history: bool,
) -> StoredRun:
    """Take from the outcome of a row what is stored of it, see `compute`."""
    last = slice(-analysis.spectrum_revolutions, None)
    amplitude = _largest(blade.revolution_amplitude[last] for blade in result.blades)
    unbounded = np.isin(np.arange(1, len(row.blades) + 1), result.unbounded)
    strongest = int(np.argmax(np.where(unbounded == unbounded.any(), np.nan_to_num(amplitude), -1.0)))
    strongest_blade = result.blades[strongest]
    outcome = replace(strongest_blade, energy=result.energy, status=result.status, message=result.message)
    stored = stored_run(case, spec, outcome, run_key, analysis, keep_history)
    counters = ("n_steps", "n_contact_steps", "n_reversed_steps", "n_fallback_steps", "n_unconverged_steps")
    stored.attributes.update(
        {name: sum(getattr(blade, name) for blade in result.blades) for name in counters}
    )
    stored.attributes.update(
        slowest_sliding=min(blade.slowest_sliding for blade in result.blades),
        energy_residual=float(result.residual),
        disk_energy=float(result.disk_energy),
        blade=strongest + 1,
    )
    properties = {
        name: np.array([getattr(blade, name) for blade in row.blades])
        for name in ("angle", "length", "damping")
    }
    stored.data.update({f"blade_{name}": values for name, values in properties.items()})
    stored.data.update(
        row=np.array(row.to_json()),
        blade=np.arange(1, len(row.blades) + 1),
        blade_frequency=np.array([blade.frequency_factors(1)[0] - 1 for blade in row.blades]),
        blade_peak=_largest(blade.revolution_peak[last] for blade in result.blades),
        blade_amplitude=amplitude,
        blade_worn_volume=result.worn_volume,
        blade_unbounded=unbounded.astype(np.int8),
        blade_energy_residual=np.array([blade.energy.residual for blade in result.blades]),
    )
    return stored


def _largest(of_blades: Iterable[np.ndarray]) -> np.ndarray:
    """Largest of some numbers of each blade; NaN where it has none."""
    return np.array([np.fmax.reduce(numbers) for numbers in of_blades])
