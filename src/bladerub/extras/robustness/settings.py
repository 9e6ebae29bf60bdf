"""What a plan of robustness holds."""

from typing import Annotated, Literal

from pydantic import Field

from bladerub.config.fields import Form, Name, Section, Seed
from bladerub.extras.design import Claims, Factors, Variation


class RobustnessPart(Section):
    """One small study for some of the claims."""

    claims: Claims
    samples: Annotated[
        Literal[2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096], Form("a power of two from 2 to 4096")
    ]
    """Their number; a power of two for the balance of the Sobol sequence."""
    study: Variation


class RobustnessPlan(Section):
    """Factors that vary, and small studies for some of the claims (studies/robustness/README.md)."""

    seed: Seed
    """Of the scrambling of the Sobol sequence."""
    factors: Factors
    parts: dict[Name, RobustnessPart] = Field(min_length=1, max_length=100)
    """Small studies, by name."""
