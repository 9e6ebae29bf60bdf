"""Passes of a rigid tip over a coated disk, by the law of an element and the profile of the time loop.

1. The tip is prescribed, so every element of the track goes through the same: one is computed. The others
   under the tip are it a little earlier or later, and the force of the tip is its mean over one passage.
2. The force of the elements is turned by θ against the motion, as in the time loop. The tip also pays what
   the elements take up by wear: that energy over the width of an element is a force along the track.
3. A law that heats warms the element by what friction and wear take from each pass, and lets it cool until
   the next.
"""

import math
from collections.abc import Iterable
from types import ModuleType
from typing import Any

import numpy as np
import pandas as pd

from bladerub.contact.laws import module_for, module_of
from bladerub.contact.spec import TipProfile
from bladerub.contact.tip import coverage, edge, relief
from bladerub.extras.rig.spec import MEASURABLE, Rig
from bladerub.numerics.vectors import LANES

ELEMENTS, STEPS = 40, 8  # under the tip, and time steps in the passage of one
COLUMNS = ("pass", "tip_depth", *MEASURABLE, "energy_residual")  # of `simulate_passes`


def simulate_passes(rig: Rig, elements: int = ELEMENTS, steps: int = STEPS) -> pd.DataFrame:
    """Simulate the passes of a rig; a row each, with `COLUMNS`.

    ``tip_depth`` is below the unworn surface (m), ``normal_force`` and ``tangential_force`` are means on the
    tip (N), their impulses over the coated part of the track (N s), ``largest_pressure`` on an element (Pa),
    ``worn_depth`` so far and ``pass_wear`` (m), ``pass_energy`` that the coating takes up (J),
    ``temperature_rise`` of the surface when the pass begins (K; NaN if the law knows no heat), and
    ``energy_residual``: work of the tip on an element less what it takes up, over the work exchanged. Raises
    `ValueError` if a parameter of the law is out of its range.
    """
    width = rig.tip_length / elements
    area, tip = rig.tip_width * width, TipProfile(elements / 2, rig.edge_drop)
    law, coated = module_of(rig.law), rig.coated or rig.track
    element = law.element(rig.coating, np.array(area), width / steps / rig.speed)
    offset = np.linspace(edge(tip), -edge(tip), (elements + 1) * steps + 1)
    share, below = coverage(tip, offset), relief(tip, offset)
    layer = None
    if hasattr(law, "Layer"):  # that of the time loop, with a row for the element
        layer = law.Layer(law, rig.coating, np.full(LANES, area), rig.track / rig.speed)
        heat = module_for(LANES, "contact.kernel.records", rig.coating.element_law).at_rest(1, 1)
    wear, rise, strength, rows = 0.0, math.nan, 1.0, []
    for number in range(1, rig.passes + 1):
        depth = number * rig.incursion
        if layer:
            rise, strength = float(layer.rise(heat)[0, 0]), float(heat.strength[0, 0])
        cold_forces, worn, cold_energy, residual = _one_passage(law, element, depth - below, wear)
        forces, energy = strength * cold_forces, strength * cold_energy
        tip_force = np.trapezoid(share * forces, dx=1 / steps)
        if layer:  # it is warmed in the pass, and cools until the next
            heat.taken[0, 0], heat.taken[0, LANES] = energy, math.sin(rig.theta) * tip_force * width
            layer.rest(heat, 0, 1)
        normal = math.cos(rig.theta) * tip_force
        tangential = math.sin(rig.theta) * tip_force + energy / width
        impulses = (normal * coated / rig.speed, tangential * coated / rig.speed)
        losses = (worn, worn - wear, energy * coated / width)
        row = (number, depth, normal, tangential, *impulses, forces.max() / area, *losses, rise, residual)
        rows.append(row)
        wear = worn
    return pd.DataFrame(rows, columns=list(COLUMNS))


def table(rigs: Iterable[Rig]) -> pd.DataFrame:
    """Simulate the passes of rigs; a row each, with the ``rig`` and its ``element_law``."""
    passes = {(rig.name, rig.law.label): simulate_passes(rig) for rig in rigs}
    table = pd.concat(passes, names=["rig", "element_law", "index"])
    return table.reset_index().drop(columns="index")


def compared(rigs: Iterable[Rig], passes: pd.DataFrame) -> pd.DataFrame:
    """Set the last pass of each rig beside what was measured, or NaN: a row for each of `MEASURABLE`.

    ``assumed`` lists the parameters that the ``source`` does not give.
    """
    rows = []
    for rig in rigs:
        last = passes[passes.rig == rig.name].iloc[-1]
        for name in MEASURABLE:
            measured = rig.measured.get(name, float("nan"))
            rows.append((rig.name, name, last[name], measured, ", ".join(rig.assumed), rig.source))
    return pd.DataFrame(rows, columns=["rig", "quantity", "computed", "measured_on_rig", "assumed", "source"])


def _one_passage(law: ModuleType, element: Any, depth: np.ndarray, wear: float) -> tuple:
    """Press an element along `depth` (n,) below its original surface (m); it was worn by `wear` before.

    The edge of the tip comes down on it in the first step, and leaves it in the last. Returns, without heat,
    its forces (n,), N, wear after it, m, energy taken up, J, and what this leaves of the
    work of the tip on it, over the work exchanged.
    """
    forces, energy, work, exchanged, before = np.zeros(depth.size), 0.0, 0.0, 0.0, 0.0
    for i, level in enumerate(depth):
        force, increment = law.return_mapping(element, level - wear, wear)
        taken = float(law.dissipated_energy(element, wear, increment, before, force))
        stored = float(law.stored_energy(element, force))
        wear, energy = wear + float(increment), energy + taken
        contribution = taken + stored if i == 0 else 0.5 * float(before + force) * (level - depth[i - 1])
        work, exchanged = work + contribution, exchanged + abs(contribution)
        forces[i] = before = force
    missing = abs(work - stored - energy)
    return forces, wear, energy, missing / exchanged if exchanged else 0.0
