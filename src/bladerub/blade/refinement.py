"""More fit speeds and more modes, for a blade whose reduced model needs them."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from bladerub.blade.accuracy import errors_by_mode
from bladerub.io.errors import BadInput

if TYPE_CHECKING:
    from bladerub.blade.build import BuiltBlade

log = logging.getLogger(__name__)

MODES = 6
"""Modes that the reduced model must follow, as the paper's does with its η."""
MOST_FIT_SPEEDS = 7
MOST_MODES_PER_SPEED = 30


def reduce_within(
    attempt: Callable[[Mapping[str, Any]], BuiltBlade], reduction: Mapping[str, Any], most_fit_speeds: int
) -> BuiltBlade:
    """Reduce a blade, until its error is below ``reduction.tolerance`` where the config has one.

    The error is the largest relative one of the first `MODES` frequencies at the accuracy speeds. As long as
    the speed law alone has more than half of what is allowed, it gets one fit speed more, else each speed
    gets two modes more.

    Parameters
    ----------
    attempt : callable
        Reduces the blade by a ``reduction`` block.
    reduction : mapping
        The block of the config.
    most_fit_speeds : int
        How many there can be.

    Raises
    ------
    BadInput
        If the tolerance is not reached; says how near it comes.
    """
    asked = dict(reduction)
    tolerance = asked.get("tolerance")
    while True:
        built = attempt(asked)
        if tolerance is None:
            return built
        errors = errors_by_mode(built.accuracy)[:MODES].max()
        n_speeds, n_modes = asked.get("fit_speeds", 3), asked["modes_per_speed"]
        log.info("%d fit speeds, %d modes at each: error %.3g", n_speeds, n_modes, errors.reduced_model)
        if errors.reduced_model <= tolerance:
            return built
        if errors.speed_law > tolerance / 2 and n_speeds < most_fit_speeds:
            asked["fit_speeds"] = n_speeds + 1
        elif n_modes < MOST_MODES_PER_SPEED:
            asked["modes_per_speed"] = n_modes + 2
        else:
            raise BadInput(
                f"reduction.tolerance = {tolerance:g}: the reduced model comes to "
                f"{errors.reduced_model:.2g} with {n_speeds} fit speeds and {n_modes} modes at each (eq. (2) "
                f"alone to {errors.speed_law:.2g}); must be more, or lower reduction.f_omega_max or "
                "reduction.rank_tolerance"
            )
