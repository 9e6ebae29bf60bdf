"""The reduction of a discretised blade, with more fit speeds and modes where a tolerance asks for them."""

import logging
from collections.abc import Callable
from dataclasses import replace

from bladerub.blade.built import BuiltBlade
from bladerub.blade.discrete import DiscreteBlade
from bladerub.blade.files import made_from
from bladerub.blade.reduction import reduce
from bladerub.extras.blade_doubts import MODES, errors_by_mode
from bladerub.io.errors import BadInput
from bladerub.settings.blade import BladeSpec

MOST_FIT_SPEEDS, MOST_MODES_PER_SPEED = 7, 30

log = logging.getLogger(__name__)


def reduce_to_tolerance(
    discrete: Callable[[int], DiscreteBlade], config: BladeSpec, most_fit_speeds: int | None
) -> BuiltBlade:
    """Reduce the blade that `discrete` gives for a number of fit speeds, at most `most_fit_speeds`.

    The largest relative error of the first `MODES` frequencies at the accuracy speeds must be below
    ``reduction.tolerance``. While eq. (2) alone has more than half of what is allowed, one fit speed is
    added, else two modes at each speed. If that is not enough, a BadInput states the error that is reached.
    """
    reduction, most = config.reduction, most_fit_speeds or MOST_FIT_SPEEDS
    tolerance, n_speeds, n_modes = reduction.tolerance, reduction.fit_speeds or 3, reduction.modes_per_speed
    while True:
        finer = config.replaced("reduction.fit_speeds", n_speeds)
        built = reduce(discrete(n_speeds), finer.replaced("reduction.modes_per_speed", n_modes))
        errors = errors_by_mode(built.accuracy)[:MODES].max()
        log.info("%d fit speeds, %d modes at each: error %.3g", n_speeds, n_modes, errors.reduced_model)
        if errors.reduced_model <= tolerance:
            return replace(built, made_from=made_from(config))
        if errors.speed_law > tolerance / 2 and n_speeds < most:
            n_speeds += 1
        elif n_modes < MOST_MODES_PER_SPEED:
            n_modes += 2
        else:
            state = f"{errors.reduced_model:.2g} with {n_speeds} fit speeds and {n_modes} modes at each"
            reached = f"the reduced model comes to {state} (eq. (2) alone to {errors.speed_law:.2g})"
            rule = "must be more, or lower reduction.f_omega_max or reduction.rank_tolerance"
            raise BadInput(f"reduction.tolerance = {tolerance:g}: {reached}; {rule}")
