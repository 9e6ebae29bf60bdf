"""Two blades compared: their figures, and the same coatings at the speeds that both studies have."""

from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd

from bladerub.blade.built import BuiltBlade
from bladerub.blade.frequencies import tip_lean
from bladerub.blade.model import ReducedBlade
from bladerub.extras.blade_doubts import errors_by_mode
from bladerub.settings.study import Config
from bladerub.study import divergence
from bladerub.study.maps import CoatingMap

BLADE_COLUMNS = ["blade", "number", "value", "unit"]
RUN_COLUMNS = [
    *("casing", "E", "K", "theta", "f_omega", "lobes", "worn_depth_share", "divergent"),
    *("reference_lobes", "reference_worn_depth_share", "reference_divergent"),
]
"""Columns of the two tables, described in ``columns.csv``; ``reference_*`` are of the other study."""


def blades(built: Mapping[str, BuiltBlade]) -> pd.DataFrame:
    """List the figures of each blade, by its name: a row each, with `BLADE_COLUMNS`."""
    rows = [(name, *row) for name, blade in built.items() for row in _figures(blade)]
    return pd.DataFrame(rows, columns=BLADE_COLUMNS)


def _figures(built: BuiltBlade) -> list[tuple[str, float, str]]:
    table, lean, errors = built.accuracy, tip_lean(built.reduced), errors_by_mode(built.accuracy)
    first = table[table["mode"] == 1].sort_values("f_omega").f_fe.to_numpy()
    at_rest = table[table.f_omega == 0].set_index("mode").f_fe
    # A blade of matrices does not say how far rotation moves it
    moved = max(np.linalg.norm(built.static_displacement[-1:], axis=-1).ravel(), default=np.nan)
    return [
        ("f1", at_rest[1], "Hz"),
        ("f2_over_f1", at_rest[2] / at_rest[1], "1"),
        ("f3_over_f1", at_rest[3] / at_rest[1], "1"),
        ("stiffening", first[-1] / first[0], "1"),
        ("lean_leading_edge", lean[0], "1"),
        ("lean_trailing_edge", lean[-1], "1"),
        ("radial_compliance", radial_compliance(built.reduced), "m/N"),
        ("centrifugal_displacement", moved, "m"),
        ("error_eq2", errors.speed_law.loc[:7].max(), "1"),
        ("error_modes_1_to_6", errors.reduced_model.loc[:6].max(), "1"),
        ("error_mode_7", errors.reduced_model.get(7, np.nan), "1"),
        ("coordinates", len(built.reduced.mass), "1"),
    ]


def radial_compliance(blade: ReducedBlade) -> float:
    """Mean radial displacement of the tip at rest per newton that is spread evenly over its nodes, m/N."""
    force = np.zeros(len(blade.mass))
    force[: 3 * blade.n_interface] = blade.radial_direction.ravel() / blade.n_interface
    return float(force @ np.linalg.solve(blade.stiffness_0, force))


def runs(config: Config, pairs: Iterable[tuple], lengths: tuple[float, float]) -> pd.DataFrame:
    """Compare maps of this study and of the reference at common speeds: rows of `RUN_COLUMNS`.

    Each of the `pairs` has both maps of a coating; `lengths` (m) are those of the two blades.
    """
    tables = [pd.DataFrame(columns=RUN_COLUMNS)]
    for one, other in pairs:
        reference = _of(config, other, lengths[1]).add_prefix("reference_")
        table = _of(config, one, lengths[0])
        tables.append(table.merge(reference, left_on="speed", right_on="reference_speed"))
    return pd.concat(tables[1:] or tables, ignore_index=True)[RUN_COLUMNS]


def _of(config: Config, coating: CoatingMap, length: float) -> pd.DataFrame:
    case = coating.case
    columns = {name: getattr(case, name) for name in ("casing", "E", "K", "theta")}
    columns |= {"f_omega": coating.f_omega, "lobes": coating.lobes}
    columns["speed"] = coating.f_omega.round(9)  # of grids with other steps
    columns["worn_depth_share"] = coating.wear.mean(axis=1) / length  # mean over casing, of a blade's length
    columns["divergent"] = [verdict.divergent for verdict in divergence.verdicts(config, coating)]
    return pd.DataFrame(columns)
