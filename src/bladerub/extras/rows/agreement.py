"""Whether the row of blades of a config can be computed."""

import math
from collections.abc import Iterator

import numpy as np

from bladerub.config.checks import reads
from bladerub.extras.rows.spec import Row
from bladerub.extras.rows.study import described
from bladerub.io.errors import format_value
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases


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
