"""What a config says of ensembles."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.fields import Metre, Section, Seed


class Ensemble(Section):
    """Runs at the peaks and of claims, repeated from other starts (studies/ensembles/README.md)."""

    members: int = Field(8, ge=0, le=1000)
    """So many starts of each run, besides the study's own; with 0 nothing is repeated, and there are no
    bands."""
    displacement: Metre = Field(1.0e-7, gt=0, le=1e-5)
    """Largest one at the start, of node 1, radially, in the first mode: far above rounding, far below the
    tolerance to which a blade tip is made."""
    seed: Seed = 1
    """Another seed draws other starts."""


ENSEMBLE = Annotated[Ensemble, Field(default=Ensemble())]
