"""Alternating stress of the blade for each coating of the chart, to be laid beside a fatigue limit.

No run of the chart keeps its motion. The runs with the greatest amplitude on each engine order and with the
greatest displacement are made again, two or three of some fifty; the stress at another speed may be higher.
"""

from pathlib import Path

import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.extras.chart.point import chart_orders
from bladerub.extras.chart.table import COATING
from bladerub.extras.stress.run import BladeStress
from bladerub.io import tables
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec

COLUMNS = [*COATING, "alternating", "f_alternating"]
"""Columns of ``chart_stress.csv``."""


@threadpool_limits.wrap(limits=1, user_api="blas")  # the products are small
def table(mesh: str | Path, blade: ReducedBlade, config: Config, chart: pd.DataFrame) -> pd.DataFrame:
    """Find the largest alternating stress of each row of ``chart.csv`` and the speed of it.

    `mesh` is the ``mesh.h5`` of the blade. A run that completes no revolution has no stress. Raises
    `BadInput` where the blade is of matrices alone.
    """
    stress, rows = BladeStress(mesh, blade), []
    last = config.analysis.spectrum_revolutions
    speed_columns = ["f_at_peak", *(f"f{order}" for order in chart_orders(config))]
    for point in chart.to_dict("records"):
        case = CoatingCase(*(point[name] for name in COATING))
        stresses = {}
        for f_omega in sorted({point[name] for name in speed_columns if pd.notna(point[name])}):
            _, of_run = stress.of_run(run_spec(config, case, f_omega), last)
            if of_run is not None:
                stresses[f_omega] = of_run.last["alternating"]
        speed = max(stresses, key=lambda f_omega: stresses[f_omega], default=None)
        rows.append({name: point[name] for name in COATING})
        rows[-1] |= {"alternating": stresses.get(speed), "f_alternating": speed}
    return pd.DataFrame(rows, columns=COLUMNS)


def read_chart(chart: str | Path, stress: str | Path | None = None) -> pd.DataFrame:
    """Read ``chart.csv``, with the columns of ``chart_stress.csv`` where that is given."""
    rows = tables.read(chart)
    if stress is None:
        return rows
    return rows.merge(tables.read(stress, COLUMNS), on=COATING, how="left", validate="one_to_one")
