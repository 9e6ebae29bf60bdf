"""Rows of blades as runs of a study (`bladerub.study.solver`)."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from bladerub.api.arguments import InputError
from bladerub.blade.model import ReducedBlade
from bladerub.config.checks import reads
from bladerub.contact.spec import RunSpec
from bladerub.extras.rows.spec import Disk, Row
from bladerub.io import sources
from bladerub.io.errors import format_value
from bladerub.settings.analysis import Analysis
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, coating_cases
from bladerub.study.store import StoredRun, stored_run
from bladerub.study.summary import displacement_peak

DATASETS = {
    "row": ((), "1", "the row of blades, as bladerub.Row.from_json reads it"),
    "blade": (("blade",), "1", "number of the blade in the row, counted from 1"),
    "blade_angle": (("blade",), "rad", "angle by which the blade is ahead of the start"),
    "blade_length": (("blade",), "m", "tip radius of the blade beyond the nominal one"),
    "blade_frequency": (("blade",), "1", "relative deviation of the first frequency of the blade"),
    "blade_damping": (("blade",), "1", "damping ratio of the blade over that of the run"),
    "blade_peak": (("blade",), "m", "largest absolute radial displacement of node 1, last revolutions"),
    "blade_amplitude": (
        ("blade",),
        "m",
        "largest half range of the radial displacement of node 1 in a revolution, last revolutions",
    ),
    "blade_worn_volume": (("blade",), "m3", "volume of coating that the blade has worn off"),
    "blade_unbounded": (("blade",), "1", "1 where the blade left the displacement limit"),
    "blade_energy_residual": (("blade",), "1", "what the ledger of the blade misses, without the disk"),
}
"""What a run file holds of a row: dimensions, unit and meaning of each dataset, by its name."""

OF_BLADES = tuple(name for name in DATASETS if name.startswith("blade_"))
"""Those with a number for each blade."""


def described(config: Config) -> Row:
    """Describe the row of the block ``rotor``; `ValueError` if a list has another number of values."""
    rotor = config.rotor
    scatters = rotor.length_scatter or 0.0, rotor.frequency_scatter or 0.0
    drawn = Row.drawn(rotor.blades, 1 if rotor.seed is None else rotor.seed, *scatters).blades
    lists = {name: getattr(rotor, name) for name in ("length", "frequency", "angle_error", "damping")}
    disk = Disk.ring(rotor.blades, rotor.coupling) if rotor.coupling else None
    row = Row.even(rotor.blades, **{name: values for name, values in lists.items() if values}, disk=disk)
    blades = (
        replace(blade, length=blade.length + draw.length, frequency=blade.frequency + draw.frequency)
        for blade, draw in zip(row.blades, drawn, strict=True)
    )
    return replace(row, blades=tuple(blades))


@reads("rotor", "contact", "coatings", "solver", "blade")
def problems(config: Config) -> Iterator[str]:
    """Yield what is wrong with the row: its lists, its damping, and blades that could meet."""
    try:
        row = described(config)
    except ValueError as error:  # it begins with "row: "
        yield f"rotor: {str(error).partition(': ')[2]}"
        return
    usual = config.contact.damping_ratio
    ratios = (case.own.get("damping_ratio", usual) for case in coating_cases(config))
    if (ratio := max(ratios) * max(blade.damping for blade in row.blades)) >= 1:
        damping = format_value(config.rotor.damping)
        yield f"rotor.damping = {damping}: must be below 1 times the damping ratio, it comes to {ratio:g}"
    if config.blade.plugged("source") is None:
        yield from _neighbours(config, row)


def _neighbours(config: Config, row: Row) -> Iterator[str]:
    """Check what a row asks of the distance of its blades, at the largest radius of the tip."""
    contact, blade, n_elements = config.contact, config.blade, config.contact.elements
    turn = 2 * np.pi * (blade.hub_radius + blade.length)
    moved = config.solver.displacement_limit * blade.length / turn * n_elements
    fewest = math.ceil(2 * (contact.tip_profile.half_width + moved)) + 4
    starts = sorted(int(neighbour.angle / (2 * np.pi) % 1 * n_elements) for neighbour in row.blades)
    nearest = min(np.diff([*starts, starts[0] + n_elements]))
    if len(starts) > 1 and nearest < fewest:
        yield (
            f"rotor.blades = {len(starts)}: two are {nearest} of {n_elements} contact.elements apart; "
            f"must be {fewest} or more, so that they cannot meet within solver.displacement_limit"
        )


def drawn(n_blades: int, seed: int, coupling: float = 0.0, **scatters: float) -> Row:
    """Draw a row as `Row.drawn`, on a disk that couples the first mode if `coupling` is not 0."""
    disk = Disk.ring(n_blades, [coupling]) if coupling else None
    return Row.drawn(n_blades, seed, **scatters, disk=disk)


def stored(run: StoredRun) -> Row | None:
    """Return the row that a run was of; None for a single blade."""
    return Row.from_json(str(run.data["row"])) if "row" in run.data else None


def determinants(row: Row) -> dict[str, Any]:
    """Return what determines a run of `row` besides what determines one of a single blade."""
    if not isinstance(row, Row):
        raise InputError("row", row, "must be a Row")
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
    """Simulate a row; what is stored is the run of the blade that vibrates most, with `DATASETS`."""
    from bladerub.extras.rows.row import simulate_row  # loads the compiler: who plans runs alone does without

    result = simulate_row(blade, spec, row, progress)
    last = analysis.spectrum_revolutions
    amplitude, peak = (  # NaN where a blade has none
        np.array([displacement_peak(getattr(blade, name), last) for blade in result.blades])
        for name in ("revolution_amplitude", "revolution_peak")
    )
    unbounded = np.isin(np.arange(1, len(row.blades) + 1), result.unbounded)
    strongest = int(np.argmax(np.where(unbounded == unbounded.any(), np.nan_to_num(amplitude), -1.0)))
    outcome = replace(
        result.blades[strongest], energy=result.energy, status=result.status, message=result.message
    )
    run = stored_run(case, spec, outcome, key, analysis, keep_history)
    counters = ("n_steps", "n_contact_steps", "n_reversed_steps", "n_fallback_steps", "n_unconverged_steps")
    run.attributes.update(
        {name: sum(getattr(blade, name) for blade in result.blades) for name in counters},
        slowest_sliding=min(blade.slowest_sliding for blade in result.blades),
        energy_residual=float(result.residual),
        disk_energy=float(result.disk_energy),
        blade=strongest + 1,
    )
    inputs = ("angle", "length", "damping")
    run.data.update(
        {f"blade_{name}": np.array([getattr(blade, name) for blade in row.blades]) for name in inputs},
        row=np.array(row.to_json()),
        blade=np.arange(1, len(row.blades) + 1),
        blade_frequency=np.array([blade.frequency_factors(1)[0] - 1 for blade in row.blades]),
        blade_peak=peak,
        blade_amplitude=amplitude,
        blade_worn_volume=result.worn_volume,
        blade_unbounded=unbounded.astype(np.int8),
        blade_energy_residual=np.array([blade.energy.residual for blade in result.blades]),
    )
    return run
