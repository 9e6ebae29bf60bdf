"""The key of a cell: a digest of everything that determines its file (compare `bladerub.study.key`)."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from bladerub.extensions.chart.grid import ORDERS, ChartSpeeds
from bladerub.io.sources import chart_digest, solver_digest
from bladerub.study.grid import CoatingCase, run_spec


def cell_key(config: Mapping[str, Any], case: CoatingCase, speeds: ChartSpeeds, blade_digest: str) -> str:
    """Digest all that determines the file of one cell.

    Parameters
    ----------
    config : mapping
        The study.
    case : CoatingCase
        The coating.
    speeds : ChartSpeeds
        From `bladerub.extensions.chart.grid.chart_speeds`.
    blade_digest : str
        From `bladerub.study.key.blade_digest`.

    Returns
    -------
    str
        SHA-256 in hexadecimal. Other cells, and the coatings of the study, have no part in it.
    """
    analysis = config["analysis"]
    determinants = {
        "spec": asdict(run_spec(config, case, f_omega=0.0)),
        "f_omega": speeds.f_omega.tolist(),
        "uniform": np.flatnonzero(speeds.uniform).tolist(),
        "coarse": np.flatnonzero(speeds.coarse).tolist(),
        "refine_above": float(config["chart"]["speeds"]["refine_above"]),
        "orders": ORDERS,
        "window": [float(end) for end in analysis["peaks"]["speed_window"]],
        **{key: float(analysis[key]) for key in ("spectrum_revolutions", "lobe_prominence")},
        "order_halfwidth": float(analysis["peaks"]["order_halfwidth"]),
        "divergence": {key: float(value) for key, value in analysis["divergence"].items()},
        "blade": blade_digest,
        "solver": solver_digest(),
        "chart": chart_digest(),
    }
    return hashlib.sha256(json.dumps(determinants, sort_keys=True).encode()).hexdigest()
