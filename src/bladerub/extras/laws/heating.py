"""Heat in the coating: the layer of laws whose strength depends on the temperature.

1. What friction and flow take from the contact in one passage of the tip warms the element to its
   ``heated_depth``. It is a column of the layer, and exchanges no heat with its neighbours.
2. Until the next passage the heat flows towards the casing, which stays as it is: conduction in one dimension
   by finite volumes, integrated exactly in their eigenvectors. The surface loses no heat to the air.
3. In a passage the strength is that before it. It lasts some steps, in which heat goes no further than some
   micrometres.
4. The parts of the column bear the same force, so that their compliances add up (a bar in series); elastic
   and plastic strain alike, as the elastic limit is small.
"""

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
import scipy  # its parts when they are used: every call of snakemake imports this module

from bladerub.contact.spec import Coating

if TYPE_CHECKING:
    from bladerub.contact.kernel.loop import Progress, Simulation
    from bladerub.contact.kernel.records import State
    from bladerub.contact.spec import ElementLaw

PARAMETERS = ("heat_capacity", "conductivity", "heated_depth", "friction_share")
"""Of a law with this layer; ``strength(coating, rise)`` is its force over that in the cold."""
DATASETS = {
    "temperature_rise": (("node", "angle"), "K", "by which the surface of the coating is warmer at the end")
}

HEATED, CELLS = 3, 12  # finite volumes of the heated depth, all alike, and of a column, growing below it


class Layer:
    """The layer as the columns of all elements under j nodes.

    The module `law` has ``strength``, the `coating` the parameters of the law. `area` (lanes,) is the
    cross-section of an element under each node, m², `period` that of a revolution, s.
    """

    numbers = CELLS  # that a state keeps of each column

    def __init__(self, law: ModuleType, coating: Coating, area: np.ndarray, period: float):
        parameters = dict(coating.element_law.parameters)
        check(coating.element_law, coating.thickness)
        self.law, self.coating, self.area = law, coating, area
        self.height = cell_heights(coating.thickness, parameters["heated_depth"])
        self.friction_share = parameters["friction_share"]
        self.capacity = parameters["heat_capacity"] * self.height  # J/(m² K)
        rate, self.shapes = decay(self.height, parameters["heat_capacity"], parameters["conductivity"])
        self.decay = rate * period
        per_heat = np.sqrt(self.capacity[:HEATED]) / np.sum(self.capacity[:HEATED])
        self.pulse = per_heat @ self.shapes[:HEATED]  # what 1 J/m² adds to the modes

    def advance(self, simulation: "Simulation", displacement: np.ndarray, first: int) -> "Progress":
        """Integrate as `Simulation.advance`; the elements that the tip has left rest each half turn."""
        half, parts = simulation.stator.n_elements // 2, []
        for start in range(0, displacement.size, half):
            part = displacement[start : start + half]
            parts.append(simulation.integrate(part, first + start))
            if parts[-1].n_steps < part.size * simulation.steps_per_element:
                break
            first_row = first + start - half // 2  # far from where the tip is, at both ends
            self.rest(simulation.state, first_row, first_row + part.size)
        *counts, lowest, highest = zip(*parts, strict=True)
        return type(parts[0])(*map(sum, counts), min(lowest), max(highest))

    def rest(self, state: "State", first: int, last: int, turn: float = 1.0) -> None:
        """Let the rows `first` to `last`, which a tip has passed, be for a part `turn` of a revolution."""
        rows = np.arange(first, last) % len(state.taken)
        rows = rows[state.taken[rows].any(axis=1) | state.layer[rows].any(axis=1)]
        amplitude = self._amplitude_after(state, rows, turn)
        state.layer[rows] = amplitude.reshape(len(rows), state.layer.shape[1])
        state.taken[rows] = 0.0
        strength = self.law.strength(self.coating, self._temperature(amplitude))
        state.strength[rows] = self.coating.thickness / np.sum(self.height / strength, axis=-1)

    def temperature(self, state: "State") -> np.ndarray:
        """Rise of temperature (N, lanes, n) in the cells of the columns when the tip would come next, K."""
        amplitude = state.layer.reshape(*state.strength.shape, CELLS).copy()
        rows = np.flatnonzero(state.taken.any(axis=1))
        amplitude[rows] = self._amplitude_after(state, rows, 1.0)
        return self._temperature(amplitude)

    def outcome(self, state: "State") -> dict[str, np.ndarray]:
        """Return what a run has of the layer in the end, each (N, lanes)."""
        return {"temperature_rise": self.rise(state)}

    def rise(self, state: "State") -> np.ndarray:
        """Return the mean of `temperature` over the heated depth (N, lanes), K."""
        return self.temperature(state)[..., :HEATED].mean(axis=-1)

    def _amplitude_after(self, state: "State", rows: np.ndarray, turn: float) -> np.ndarray:
        """Return the temperature of rows after a part of a revolution, in the modes of conduction."""
        flow, friction = np.split(state.taken[rows], 2, axis=1)
        pulse = (flow + self.friction_share * friction) / self.area  # J/m²
        modal_pulse = pulse[..., None] * self.pulse
        return (state.layer[rows].reshape(modal_pulse.shape) + modal_pulse) * np.exp(-self.decay * turn)

    def _temperature(self, amplitude: np.ndarray) -> np.ndarray:
        return amplitude @ (self.shapes / np.sqrt(self.capacity)[:, None]).T


def check(law: "ElementLaw", thickness: float) -> None:
    """Check the parameters of a law with heat for a layer; raises `ValueError`."""
    parameters = dict(law.parameters)
    missing = [name for name in PARAMETERS if name not in parameters]
    if not missing:
        cell_heights(thickness, parameters["heated_depth"])
    elif len(missing) < len(PARAMETERS):
        raise ValueError(f"{law.name}: has heat, but no {', '.join(missing)} in PARAMETERS")


def cell_heights(thickness: float, heated_depth: float) -> np.ndarray:
    """Divide the layer into the `HEATED` cells and others in a geometric series, heights (n,), m."""
    if heated_depth >= (limit := thickness * HEATED / CELLS):
        raise ValueError(
            f"heated_depth = {heated_depth:g}: must be below {limit:g} m, a quarter of the layer"
        )
    first, below = heated_depth / HEATED, np.arange(1, CELLS - HEATED + 1)
    remainder = thickness - heated_depth
    steepest = (remainder / first) ** (1 / len(below))  # the last cell alone would fill the remainder
    ratio = scipy.optimize.brentq(lambda r: first * np.sum(r**below) - remainder, 1.0, steepest)
    return first * np.concatenate([np.ones(HEATED), ratio**below])


def decay(height: np.ndarray, heat_capacity: float, conductivity: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the rates (n,) at which modes of a column decay whose lower end stays cold, 1/s, and the modes.

    These (n, n) are orthonormal columns: temperatures times the roots of the capacities of the cells.
    """
    apart = np.append(0.5 * (height[1:] + height[:-1]), 0.5 * height[-1])
    conductance = conductivity / apart  # below each cell, W/(m² K)
    above = np.concatenate([[0.0], conductance[:-1]])
    matrix = np.diag(conductance + above) - np.diag(conductance[:-1], 1) - np.diag(conductance[:-1], -1)
    root = np.sqrt(heat_capacity * height)
    return np.linalg.eigh(matrix / np.outer(root, root))
