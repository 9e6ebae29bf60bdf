"""What a config says of a calibration, and what its plan holds."""

from typing import Annotated

from pydantic import Field

from bladerub.config.fields import ConfigFile, Form, Omitted, Section
from bladerub.extras.design import Variation

CALIBRATION = Annotated[
    ConfigFile,
    Field(
        default="config/calibration.yaml",
        description="Plan of sets of choices, each a small study of its own, made by `snakemake -j2 "
        "calibration`. A relative path is relative to the folder that Snakemake runs in.",
    ),
]

SetName = Annotated[
    str,
    Field(pattern=r"^[_.]*[A-Za-z0-9][A-Za-z0-9_.]*$", max_length=80),
    Form("of at most 80 letters, digits, dots and underscores"),
]


class CalibrationPlan(Section):
    """Variations of the study, each a small study (studies/calibration/README.md)."""

    file: Omitted[ConfigFile] = None
    """Laid over the study in every set; as seen from the plan."""
    common: Omitted[Variation] = None
    """Laid over that in every set."""
    sets: dict[SetName, Variation] = Field(min_length=1, max_length=1000)
    """What is laid over that, by name, which is that of the folder of the set."""
