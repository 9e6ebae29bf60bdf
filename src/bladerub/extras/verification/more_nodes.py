"""The study's peaks with more interface nodes on the tip: whether eight are enough.

All blades have the same mesh, which is finer along the chord than the study's, so that the nodes find even
places. More nodes give the reduced model more static modes of the tip as well.
"""

import copy
import time
from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.build import build
from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.setup import compile_kernel, strip_width
from bladerub.extras.verification.response import CASE_COLUMNS, Response, listed
from bladerub.study.grid import CoatingCase, element_law, run_spec

NODES = (8, 16, 24)
"""Numbers of interface nodes; 8 are the study's."""

CHORDWISE = 24  # elements; 49 nodes along the camber line

COLUMNS = [
    *(*CASE_COLUMNS, "order", "interface_nodes", "f_peak", "amplitude", "amplitude_change"),
    *("volume_change", "wear_difference", "status", "cpu_s"),
]
"""Columns of ``more_nodes.csv``, described in ``io/columns.csv``."""


def table(config: Mapping[str, Any], peaks: pd.DataFrame) -> pd.DataFrame:
    """Find the peaks of some coatings of `peaks`, a table ``peaks.csv``, again with more interface nodes.

    A row for each peak and number of nodes, with `COLUMNS`: the peak to which the response rises from the
    study's speed of the peak, and wear, its mean along the chord, and seconds of the run at that speed.
    """
    blades = {n: blade_with(config, n) for n in NODES}
    rows: list[dict[str, Any]] = []
    for case, peak in listed(peaks):
        start = float(peak.f_peak)
        for n, blade in blades.items():
            response = Response(blade, config, case, peak.order)
            wear, speed = _wear(response.run(start), blade), response.top(start)
            amplitude = response.amplitude(speed)
            if n == NODES[0]:
                own_wear, own_amplitude = wear, amplitude
            rows.append(
                {name: getattr(case, name) for name in CASE_COLUMNS}
                | {
                    "order": peak.order,
                    "interface_nodes": n,
                    "f_peak": speed,
                    "amplitude": amplitude,
                    "amplitude_change": amplitude / own_amplitude - 1,
                    "volume_change": wear.sum() / own_wear.sum() - 1,
                    "wear_difference": np.linalg.norm(wear - own_wear) / np.linalg.norm(own_wear),
                    "status": response.run(start).status,
                    "cpu_s": _seconds(blade, config, case, start),
                }
            )
    return pd.DataFrame(rows, columns=COLUMNS)


def blade_with(config: Mapping[str, Any], n: int) -> ReducedBlade:
    """Build the blade of `config` with `n` interface nodes, and compile the time loop for them."""
    varied = copy.deepcopy({name: config[name] for name in ("blade", "reduction")})
    varied["blade"]["mesh"] = {**varied["blade"]["mesh"], "chordwise": CHORDWISE, "thickness": 2}
    varied["reduction"]["interface_nodes"] = n
    compile_kernel(n_nodes=n, law=element_law(config))
    return build(varied).reduced


def _wear(run: RunResult, blade: ReducedBlade) -> np.ndarray:
    """Mean wear (N,) along the chord, m."""
    return np.average(run.wear, axis=0, weights=strip_width(blade))


def _seconds(blade: ReducedBlade, config: Mapping[str, Any], case: CoatingCase, f_omega: float) -> float:
    start = time.process_time()
    simulate(blade, run_spec(config, case, f_omega))
    return time.process_time() - start
