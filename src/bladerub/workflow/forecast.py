"""What a dry run says of the study: how many runs are still to be computed, and about how long that takes."""

import atexit
import copy
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bladerub.study import inventory
from bladerub.study.grid import coating_cases
from bladerub.study.plan import coating_plan

_MOST_NAMED = 8

SECONDS_PER_REVOLUTION = 0.01
"""Of one core, for a run of the paper's blade with its longer run, if it needs one; rounded up."""


def print_at_exit(config: Mapping[str, Any]) -> None:
    """Print coatings and `forecast` after the jobs that Snakemake lists."""
    study = copy.deepcopy(dict(config))
    atexit.register(
        lambda: print(f"bladerub: {coatings(study)}\nbladerub: {forecast(study)}", file=sys.stderr)
    )


def coatings(config: Mapping[str, Any]) -> str:
    """Name the coatings of the study in a line, so that a list such as ``[0,5]`` shows as two values."""
    names = [case.name for case in coating_cases(config)]
    more = len(names) - _MOST_NAMED
    return f"coatings: {', '.join(names[:_MOST_NAMED])}{f' and {more} more' if more > 0 else ''}"


def forecast(config: Mapping[str, Any]) -> str:
    """Say in a line how many runs of the study are missing, stale or corrupt, and what they cost."""
    results = Path(config["results"])
    digest, _ = inventory.current_blade(config, results / "blade" / "reduced_model.h5")
    whole = inventory.total(
        inventory.take(config, coating_plan(config, case), results / "runs" / case.name, digest)[0]
        for case in coating_cases(config)
    )
    left = whole["planned"] - whole["done"]
    if not left:
        return f"all {whole['planned']:,} runs of the study are done"
    blades = config.get("rotor", {"blades": 1})["blades"]
    minutes = left * blades * config["solver"]["revolutions"] * SECONDS_PER_REVOLUTION / 60
    about = f"about {max(minutes, 1):.0f} min of one core"  # Snakemake tells a dry run of no more cores
    return f"{left:,} of {whole['planned']:,} runs of the study are to be computed, {about}"
