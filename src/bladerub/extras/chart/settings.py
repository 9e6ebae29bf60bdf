"""What a config says of the chart."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.coatings import CasingName, Theta, YoungModulus
from bladerub.settings.fields import ASCENDING, Metre, Modulus, Number, Omitted, Pascal, Section, Speed, Unit

# 24 each, even on a logarithmic scale but for the paper's 9 E and 6 K, which stand in for those next to them
_E = [0.05, 0.068, 0.091, 0.11, 0.17, 0.2, 0.3, 0.41, 0.5, 0.75, 1.1, 1.5]
_E += [2, 2.5, 3.4, 5, 6.1, 8.2, 11, 15, 20, 27, 37, 50]
_K = [0.02, 0.027, 0.036, 0.05, 0.066, 0.1, 0.12, 0.16, 0.22, 0.3, 0.4, 0.5]
_K += [0.73, 1, 1.3, 1.8, 2.4, 3.3, 5, 6, 8.1, 10, 15, 20]


class ChartSpeeds(Section):
    """Of the speeds of the study, those nearest to these are run first.

    Then the intervals next to the maxima are halved.
    """

    start: Speed = Field(0.152, ge=0.001, le=2)
    """Below speeds.stop: the lower end of the window of eo(6). Slower runs cost most."""
    step: Speed = Field(0.008, ge=1e-4, le=2)
    """Of the even speeds, up to speeds.stop; shares of divergent speeds are of these."""
    dense_stop: Speed = Field(0.24, ge=0.001, le=2)
    """Up to the end of the window of eo(6), whose peaks are narrower than those of eo(4)."""
    dense_step: Speed = Field(0.004, ge=1e-4, le=2)
    """From the lowest speed on; how often the maxima are then found is in chart_placement.csv."""
    refine_above: Number = Field(0.6, gt=0, le=1)
    """Share of the greatest from which a local maximum is refined. Irregular curves have several; 1 refines
    the greatest alone, lower values find more and cost more."""


class Limits(Section):
    """Of a safe coating: ours, not the paper's. They are drawn, and no run depends on them."""

    amplitude: Metre = Field(2.0e-3, gt=0, le=10)
    """Greatest displacement of node 1, radial, over all speeds of the chart; 1 % of the blade's length."""
    wear: Metre = Field(1.0e-3, gt=0, le=1)
    """Deepest wear under any node, over all speeds; a sixth of the layer."""
    divergent_share: Number = Field(0.0, ge=0, le=1)
    """Of the evenly spaced speeds; none."""
    fatigue: Omitted[Pascal] = Field(None, gt=0, le=1e11)
    """Greatest alternating stress of the blade at the peaks and at the greatest displacement; not limited if
    not given. Not for a blade of matrices."""


class Chart(Section):
    """A dense grid of coatings, apart from the study, made by `snakemake -j2 chart` alone.

    It shares all else with the study.
    """

    minutes: Omitted[Annotated[float, Unit("min")]] = Field(None, gt=0, le=1e5)
    """That the chart may take by the forecast for the paper's blade on chart.cores. If they are too few, it
    begins at speeds twice as far apart, and has fewer E and K. No limit if not given."""
    cores: Omitted[int] = Field(None, ge=1, le=1000)
    """Of these minutes: those of `snakemake -j`; 2 if not given."""
    casing: CasingName = "2nd"
    theta: Annotated[list[Theta], ASCENDING] = Field([0.0, 0.15], min_length=1, max_length=10)
    """A chart for each."""
    E: Annotated[list[YoungModulus], ASCENDING] = Field(_E, min_length=2, max_length=200)
    """The paper's 9 are among them, so that its 54 coatings are points of the chart."""
    K: Annotated[list[Annotated[Modulus, Field(gt=0, le=1e6)]], ASCENDING] = Field(
        _K, min_length=2, max_length=200
    )
    """The paper's 6 are among them; above 0, the chart being logarithmic."""
    speeds: ChartSpeeds = ChartSpeeds()
    limits: Limits = Limits()


CHART = Annotated[Chart, Field(default=Chart())]
