"""Divergence: the table of which runs' amplitudes keep growing, as `bladerub.study.growth` defines it."""

from collections.abc import Iterable
from dataclasses import asdict
from functools import lru_cache

import numpy as np
import pandas as pd

from bladerub.settings.analysis import Divergence
from bladerub.settings.study import Config
from bladerub.study.growth import Verdict, judge
from bladerub.study.maps import CoatingMap
from bladerub.study.variants import with_variant

COLUMNS = [
    *("casing", "E", "K", "theta", "f_omega"),
    *("growth_per_revolution", "saturating", "divergent", "lobes"),
    *("growth_low", "growth_high", "revolutions", "status", "law"),
    *("wear_harmonic", "wear_harmonic_share"),
]
"""Columns of ``divergence.csv``: f_omega is normalised, growth relative (0.03 is 3 % a revolution).

``growth_*``, ``revolutions`` and ``status`` are of the run that the verdict rests on, the longer one if there
is one; ``lobes`` and the harmonic of the wear are of the study's own run.
"""


def table(config: Config, maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Judge every run by ``analysis.divergence``: a row each, with `COLUMNS`, see `with_variant`."""
    tables = []
    for coating in maps:
        judged = verdicts(config, coating)
        growth = pd.DataFrame([verdict.growth for verdict in judged]).add_prefix("growth_")
        runs = pd.DataFrame(judged).drop(columns="growth").join(growth)
        of_map = ("f_omega", "lobes", "wear_harmonic", "wear_harmonic_share")
        runs = runs.assign(**{name: getattr(coating, name) for name in of_map})
        tables.append(runs.assign(**asdict(coating.case)))
    return with_variant(pd.concat(tables, ignore_index=True), COLUMNS)


def verdicts(config: Config, coating: CoatingMap) -> list[Verdict]:
    """Judge every run of a coating, by its longer run if it has one."""
    runs = zip(coating.revolution_amplitude, coating.status, coating.confirmation_amplitude, strict=True)
    settings = config.analysis.divergence
    return [_judged(run.tobytes(), str(status), settings, longer.tobytes()) for run, status, longer in runs]


def in_a_word(verdict: Verdict) -> str:
    """Return ``divergent``, ``saturating`` or, of a vibration that does not grow, ``bounded``."""
    return "divergent" if verdict.divergent else "saturating" if verdict.saturating else "bounded"


@lru_cache(maxsize=1 << 15)  # parts of a study and its draws have most runs in common
def _judged(amplitude: bytes, status: str, settings: Divergence, longer: bytes) -> Verdict:
    return judge(np.frombuffer(amplitude), status, settings, np.frombuffer(longer))
