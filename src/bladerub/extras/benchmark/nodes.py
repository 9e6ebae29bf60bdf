"""Speed of the time loop with more interface nodes on the tip, measured in turns."""

import statistics
from collections.abc import Sequence

from bladerub.blade.model import N_INTERFACE
from bladerub.extras.benchmark.measure import in_contact, middle_run, production
from bladerub.extras.verification.refinement import blade_with
from bladerub.settings.study import Config


def cost_by_nodes(config: Config, counts: Sequence[int], rounds: int) -> dict[str, float]:
    """Return the time of a simulation with contact, over that with eight nodes, by the number of nodes.

    Blades are those of `config`, the mesh fine enough along the chord for all.
    """
    blades = {n: blade_with(config, n) for n in (N_INTERFACE, *counts)}
    spec, _ = in_contact(blades[N_INTERFACE], middle_run(config))
    seconds = [{n: production(blade, spec) for n, blade in blades.items()} for _ in range(rounds)]
    return {str(n): statistics.median(row[n] / row[N_INTERFACE] for row in seconds) for n in counts}
