"""Snapshots of tables for the pages, small enough for the repository."""

import tempfile
from pathlib import Path

from bladerub import plugins
from bladerub.io import tables
from docs.numbers import ROOT

COUNTED = {  # tables of a row a run, which become counts (``runs``) of those with equal values in columns
    "divergence": ["casing", "E", "K", "theta", "law", "revolutions", "status", "divergent", "saturating"],
    "long_runs": ["law", "why", "revolutions", "verdict"],
}
_RUN = ("casing", "E", "K", "theta")
_COMBINATION = (*_RUN, "f_omega", "blades", "length_scatter", "frequency_scatter", "coupling")
_STATISTICS = ("median", "low", "high", "p05", "p95")
_ROWS = (
    *(*_COMBINATION, "rows", "unbounded_rows", "divergent_rows"),
    *(f"{name}_{statistic}" for name in ("row_amplitude", "amplification") for statistic in _STATISTICS),
    *(f"{name}_{statistic}" for name in ("longest_share", "largest_share") for statistic in _STATISTICS[:3]),
    *("wear_harmonic", "wear_harmonic_rows", "wear_harmonic_share_median", "lobes_lowest", "lobes_highest"),
    "energy_residual",
)
KEPT = {  # tables of which pages need these columns only, to four digits
    "accuracy": (
        *("drawn_from", *_RUN, "f_omega", "status", "sensitive", "speedup_at_equal_error"),
        *(f"{kind}_{name}" for kind in ("error", "start") for name in ("wear_l2", "peak", "revolution_peak")),
    ),
    "calibration": ("set", "id", "measured", "holds"),
    "chart": (
        *(*_RUN, "Y4", "f4", "Y6", "f6", "peak", "worn_volume", "deepest_wear", "divergent_share", "runs"),
    ),
    "chart_explanation": (
        *(*_RUN, "order", "E_T", "f_crossing", "f_peak", "amplitude", "lobes"),
        *("wear_per_cycle", "damping_per_cycle"),
    ),
    "chart_agreement": (*_RUN, "quantity", "disagreement"),
    "finer_bars": (
        *(*_RUN, "order", "elements", "f_peak", "amplitude"),
        *("amplitude_change", "volume_change", "wear_difference", "status"),
    ),
    "friction": (
        *(*_RUN, "f_omega", "difference", "reversed_coulomb", "slowest_sliding"),
        *("status_theta", "status_coulomb"),
    ),
    "rotor": _ROWS,
    "rotor_half": _ROWS,
    "rotor_drift": (*_COMBINATION, "rows", "pattern_drift_median", "pattern_drift_p05", "pattern_drift_p95"),
    "run_bands": (
        *("casing", "E", "K", "theta", "f_omega", "draws", "divergent_draws"),
        *("max_wear_median", "max_wear_low", "max_wear_high", "lobes_lowest", "lobes_highest"),
    ),
    "steps": ("E", "tolerance", "steps_per_revolution", "error", "sensitive"),
    "rigid_convergence": (
        *("f_omega", "treatment", "modes", "steps", "order", "complete", "amplitude"),
        *("amplitude_change", "largest_revolution", "median_revolution", "largest_displacement"),
    ),
    "stress": (
        *(*_RUN, "order", "f_peak", "amplitude", "status", "rotation_von_mises", "start_up_von_mises"),
        *("last_von_mises", "last_von_mises_z", "last_principal", "last_alternating"),
    ),
}
ROWS = {"fine_margins": {"variation": "study"}}  # snapshots that have only the rows with these values


def update(folder: Path, results: Path) -> None:
    """Take each snapshot in `folder` anew from its table below `results`, if this is there and differs."""
    with tempfile.TemporaryDirectory() as scratch:
        for snapshot in sorted(folder.glob("*.csv")):
            if source := source_of(snapshot.stem, results):
                taken = Path(scratch) / snapshot.name
                take(source, taken)
                if taken.read_bytes() != snapshot.read_bytes():
                    tables.copy(taken, snapshot)


def source_of(name: str, results: Path) -> Path | None:
    """Return the table of a snapshot, if made: ``longer_peaks`` in ``results/`` or ``results_longer``."""
    places = [results / "tables" / f"{name}.csv", results / "benchmarks" / f"{name}.csv"]
    words = name.split("_")
    for count in range(1, len(words)):
        study, table = "_".join(words[:count]), "_".join(words[count:])
        folders = results / study, results.with_name(f"{results.name}_{study}")
        places.extend(folder / "tables" / f"{table}.csv" for folder in folders)
    return next((place for place in places if place.exists()), None)


def take(source: Path, target: Path) -> None:
    """Take the table at `source` as the snapshot `target`, as `COUNTED`, `KEPT` and `ROWS` say."""
    name, only = source.stem, ROWS.get(target.stem, {})
    if name not in COUNTED | KEPT and not only:
        tables.copy(source, target)
        return
    table, origin, digits = tables.read(source), tables.read_origin(source), None
    for column, value in only.items():
        table = table[table[column] == value]
    if name in COUNTED:
        table = table.groupby(COUNTED[name], as_index=False).size().rename(columns={"size": "runs"})
    elif name in KEPT:
        table, digits = table[[*KEPT[name]]], "%.4g"
    columns_files = [*plugins.files("columns.csv"), *ROOT.glob("studies/*/columns.csv")]
    tables.write(target, table, origin, digits, columns_files)
