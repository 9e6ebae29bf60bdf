"""What the ensembles of a coating cost, known before its runs are."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from bladerub.study.grid import CoatingCase, between, keeps_history, speeds
from bladerub.study.orders import peak_orders
from bladerub.study.paper import LOBES, WORN

FOLLOWED = 2
"""Cost of a member at the claims on lobes: about half of these grow, and are followed three times as long."""

REFINED = 2
"""Steps of a refined run, over those of a run of the study."""


def expected_cost(config: Mapping[str, Any], case: CoatingCase) -> int:
    """Count the members of a coating before its peaks are known, as if no two were next to each other.

    Refined runs count as `REFINED`, those of the claims on lobes as `FOLLOWED`.
    """
    if not config["ensemble"]["members"]:
        return 0
    by_name = int(named(config, case, np.array(speeds(config))).sum()) * (FOLLOWED if case == WORN else 1)
    return (config["ensemble"]["members"] + REFINED) * (by_name + 3 * len(peak_orders(config, case.casing)))


def named(config: Mapping[str, Any], case: CoatingCase, f_omega: np.ndarray) -> np.ndarray:
    """Which (n,) of the speeds `f_omega` have an ensemble wherever the peaks are: by history or claim."""
    mask = np.array([keeps_history(config, case, float(f)) for f in f_omega])
    if case == WORN:
        for low, high in LOBES:
            mask |= between(f_omega, low, high)
    return mask
