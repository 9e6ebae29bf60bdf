"""Reference numbers with their uncertainty: from the same numbers for a plan of variations."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from bladerub.config import read as configuration
from bladerub.extras.rotor37.numbers import COLUMNS as NUMBERS
from bladerub.extras.variations.plan import read
from bladerub.io import tables
from bladerub.io.folders import CONFIG, ROOT
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases

PLAN = ROOT / "config" / "rotor37_reference.yaml"  # what is computed, and with which variations
REFERENCE = "reference"  # the set of the plan whose numbers are quoted
VARIATIONS = ("step", "modes", "mesh", "nodes")  # the sets whose differences from them are the uncertainty


def plan() -> dict[str, Config]:
    """Return the config of each set of the plan, laid over the paper's study, whatever that at work is."""
    study = configuration.read(ROOT / CONFIG)
    return {
        name: configuration.validate(configuration.vary(study, *part.study), name)
        for name, part in read("calibration", PLAN).parts.items()
    }


def tables_of(folder: str, config: Config) -> dict[str, pd.DataFrame]:
    """Read the numbers of all sets in `folder` into tables by name, each as of `with_uncertainty`."""
    parts = {"blade": ["blade"], "direct": ["direct"], "interaction": [], "coatings": []}
    for case in coating_cases(config):
        parts["interaction" if case.is_rigid else "coatings"].append(case.name)

    def joined(of_set: str, files: Sequence[str]) -> pd.DataFrame:
        return pd.concat(tables.read(f"{folder}/{of_set}/numbers/{file}.csv", NUMBERS) for file in files)

    return {
        name: with_uncertainty({of_set: joined(of_set, files) for of_set in (REFERENCE, *VARIATIONS)})
        for name, files in parts.items()
    }


def with_uncertainty(numbers: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """Combine the numbers of all sets, by name: tables with the columns of `numbers.COLUMNS`.

    The uncertainty is the root of the sum of squares of the changes by each variation and of the resolution.
    A number that a variation lacks is left out, such as a peak where no run stays bounded.
    """
    table = numbers[REFERENCE].set_index("number")
    for name in VARIATIONS:
        table[f"by_{name}"] = numbers[name].set_index("number").value - table.value
    changes = table.drop(columns=["value", "unit"])
    table["uncertainty"] = np.sqrt((changes**2).sum(axis=1, skipna=False))
    changed = [f"by_{name}" for name in VARIATIONS]
    return table.dropna().reset_index()[["number", "value", "unit", "uncertainty", "resolution", *changed]]
