"""How runs become spectra, maps, tables and figures."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.coatings import Histories
from bladerub.settings.fields import ASCENDING, UNIQUE, Limit, Metre, Number, Omitted, Section, Speed, Unit

EngineOrder = Annotated[
    int,
    Limit("at most", "analysis.max_order"),
    Field(ge=1, le=1000, description="Vibrations in one revolution."),
]
EngineOrders = Annotated[list[EngineOrder], UNIQUE, Field(min_length=1, max_length=1000)]


class Peaks(Section):
    """How Y4, f4, Y6 and f6 are read from the maps."""

    orders: EngineOrders
    """4 and 6, as in Fig. 10; casings.<name>.peak_orders is for casings that do not excite them."""
    order_halfwidth: Annotated[float, Unit("engine orders")] = Field(gt=0, le=0.5)
    """The peak lies on the engine-order line to within this; at 0.5 neighbouring lines meet."""
    speed_window: Annotated[list[Annotated[float, Unit("crossing speeds"), Field(gt=0, le=5)]], ASCENDING] = (
        Field(min_length=2, max_length=2)
    )
    """In units of the speed where the engine order crosses C1 of the free blade: contact stiffening moves
    peaks up from there."""


class Divergence(Section):
    """When a run is called divergent or saturating; defined in src/bladerub/study/growth.py."""

    revolutions: Annotated[int, Limit("at most", "solver.revolutions")] = Field(ge=3, le=10000)
    """Of the fit of growth: the last ten, past the transient; fewer than three show no scatter, fewer than
    four no bend."""
    growth: Annotated[float, Unit("1/revolution")] = Field(ge=0, le=10)
    """Relative growth of the amplitude in one revolution; a run grows when it is surely above."""
    confidence: Number = Field(ge=0.5, le=0.9999)
    """Of the two-sided intervals of growth and curvature, usually 0.95."""
    confirmation_revolutions: int = Field(ge=0, le=10000)
    """A run that grows goes on to this number, and is judged by the last of them; with 0 every run is
    judged by its own. Three times the paper's 20 show the end of most growth."""


class Analysis(Section):
    """How runs become spectra, maps and tables."""

    spectrum_revolutions: Annotated[int, Limit("at most", "solver.revolutions")] = Field(ge=1, le=10000)
    """The last ten, as in the paper."""
    max_order: Annotated[
        float,
        Unit("engine orders"),
        Limit("at most", "contact.elements", "there is one sample an element", divisor=2),
    ] = Field(ge=1, le=10000)
    """Highest engine order kept. Covers C1 (order 50 at f_omega = 0.02)."""
    peaks: Peaks
    divergence: Divergence
    lobe_prominence: Annotated[float, Unit("greatest worn depths")] = Field(gt=0, lt=1)
    """How much a worn lobe must stand out to be counted."""
    histories: Histories = Field(max_length=10000)
    """Runs whose whole displacement is kept, those of Figs. 17 and 18. Those that the study does not have are
    left out."""


class Figures(Section):
    """Appearance only."""

    dpi: int = Field(ge=30, le=1200)
    """Of the PNG files: sharp on a screen, small in a repository."""
    max_frequency: Speed = Field(gt=0, le=100)
    """Top of the spectrum figures. Shows C1 and the engine orders that the paper discusses."""
    amplitude_range: Annotated[list[Annotated[Metre, Field(gt=0, le=1)]], ASCENDING] = Field(
        min_length=2, max_length=2
    )
    """Logarithmic colour scale of all spectrum figures, so that they can be compared."""
    nominal_speed: Omitted[Annotated[float, Unit("1/min")]] = Field(None, gt=0, le=1e6)
    """Of the rotor: figures over the speed have a line there. None if not given."""
