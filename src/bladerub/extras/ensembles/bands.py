"""Bands: median and spread of what a study shows, over the draws that its ensembles make.

A *draw of the study* is the study with the runs of one member of each ensemble
(`bladerub.extras.ensembles.ensemble`) in place of its own; the study itself is the first draw. What its
tables say of a run, a peak or a claim is evaluated on each of them.

The band of n draws is the interval in which a further draw falls with probability `PROBABILITY`, if draws are
distributed normally: ``mean ± t s √(1 + 1/n)``. Here s is their standard deviation, and t the quantile of
Student's distribution with n − 1 degrees of freedom. The band shrinks to a point for a run that is not
chaotic. With few draws it is wider than their range: nine of them span but 80 % of their distribution.

The refined runs of the ensembles show what error the time step makes. Theirs is a quarter of that of the
study, so that they differ by three quarters of it (`ERROR`). Where a run is chaotic, the difference is that
of two draws, and lies within the band.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import scipy

from bladerub.extras.ensembles.ensemble import Ensemble
from bladerub.extras.study_runs import judged
from bladerub.settings.study import Config
from bladerub.study import divergence, findings, peaks
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase, modulus_unit
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import peak_settings
from bladerub.study.variants import plain, with_variant

PROBABILITY = 0.9
"""Probability of a draw to fall into the band: 5 % lie below and 5 % above it."""

ERROR = 4 / 3
"""Error that the step makes, over the difference from refined runs."""

_ENDS = ("median", "low", "high")

PEAK_COLUMNS = [
    "draws",
    *(f"{name}_{end}" for name in ("f_peak", "amplitude") for end in _ENDS),
    "f_peak_error",
    "amplitude_error",
]
"""Columns of ``peak_bands.csv`` besides those of ``peaks.csv``."""

RUN_COLUMNS = [
    *("casing", "E", "K", "theta", "f_omega", "law", "growth_per_revolution"),
    *("draws", "divergent_draws", "saturating_draws"),
    *(f"{name}_{end}" for name in ("growth_rate", "max_wear") for end in _ENDS),
    *("lobes_lowest", "lobes_highest", "max_wear_error"),
]
"""Columns of ``run_bands.csv``: the first growth is that of the study's own run, as in ``divergence.csv``."""

JUDGED_COLUMNS = ["divergent_draws", "saturating_draws", *(f"growth_rate_{end}" for end in _ENDS)]
"""Those that runs have whose members are followed; NaN for others."""


class Band(NamedTuple):
    """Median of draws, and the interval in which a further one falls with `PROBABILITY`."""

    median: float
    low: float
    high: float


def band(values: Sequence[float] | np.ndarray) -> Band:
    """Find the band of draws (n,), NaN being none; NaN throughout from no draw, without ends from one."""
    draws = np.asarray(values, dtype=float)
    draws = draws[np.isfinite(draws)]
    if draws.size < 2:
        return Band(float(draws[0]) if draws.size else math.nan, math.nan, math.nan)
    t = float(scipy.special.stdtrit(draws.size - 1, (1 + PROBABILITY) / 2))
    half = t * float(draws.std(ddof=1)) * math.sqrt(1 + 1 / draws.size)
    return Band(float(np.median(draws)), float(draws.mean() - half), float(draws.mean() + half))


def draws(ensembles: Sequence[Ensemble]) -> list[tuple[CoatingMap, ...]]:
    """List the runs of each draw of the study: those of one member of each of the `ensembles`."""
    return list(zip(*(ensemble.members for ensemble in ensembles), strict=False))  # as many as all have


def with_runs(
    maps: Sequence[CoatingMap], ensembles: Sequence[Ensemble], runs: Sequence[CoatingMap]
) -> list[CoatingMap]:
    """Return the study of these `maps` with `runs`, of a member of each ensemble, in place of its own."""
    coatings = {coating.case: coating for coating in maps}
    for ensemble, drawn in zip(ensembles, runs, strict=True):
        coatings[drawn.case] = ensemble.draw(coatings[drawn.case], drawn)
    return list(coatings.values())


def of_peaks(config: Config, maps: Sequence[CoatingMap], ensembles: Sequence[Ensemble]) -> pd.DataFrame:
    """Find the peaks of every coating, with `PEAK_COLUMNS` and what E = 1 and K = 1 are, Pa."""
    refined = [ensemble.refined for ensemble in ensembles]
    study_peaks = peaks.table(config, maps)
    *drawn, finer = (
        peaks.table(config, with_runs(maps, ensembles, runs)) for runs in [*draws(ensembles), refined]
    )
    table, cases = study_peaks.assign(draws=1 + len(drawn)), {runs.case for runs in refined}
    orders = [(coating.case, peak_settings(config, coating.case.casing).orders) for coating in maps]
    is_refined = [case in cases for case, of_case in orders for _ in of_case]
    for name in ("f_peak", "amplitude"):
        bands = [band(values) for values in np.transpose([draw[name] for draw in (study_peaks, *drawn)])]
        table = table.join(pd.DataFrame(bands, index=table.index).add_prefix(f"{name}_"))
        table[f"{name}_error"] = (ERROR * (finer[name] - table[name]).abs()).where(is_refined)
    return table[[*study_peaks.columns, *PEAK_COLUMNS]].assign(modulus_unit=modulus_unit(config))


def of_runs(config: Config, maps: Sequence[CoatingMap], ensembles: Sequence[Ensemble]) -> pd.DataFrame:
    """Find the bands of each run that has an ensemble: a row each, with `RUN_COLUMNS`, see `with_variant`."""
    coatings = {coating.case: coating for coating in maps}
    rows = [row for ensemble in ensembles for row in _run_bands(config, coatings, ensemble)]
    return with_variant(pd.DataFrame(rows), RUN_COLUMNS)


def _run_bands(
    config: Config, maps: Mapping[CoatingCase, CoatingMap], ensemble: Ensemble
) -> Iterator[dict[str, Any]]:
    """Yield a row for each speed of the ensembles of one coating."""
    coating = maps[ensemble.members[0].case]
    places = ensemble.places(coating)
    verdicts = [divergence.verdicts(config, runs) for runs in (coating, *ensemble.members)]
    verdicts[0] = [verdicts[0][place] for place in places]
    max_wear = np.stack([coating.max_wear[places], *(member.max_wear for member in ensemble.members)])
    lobes = np.stack([coating.lobes[places], *(member.lobes for member in ensemble.members)])
    followed = np.isin(coating.f_omega[places], judged(config, coating))
    for index, drawn in enumerate(zip(*verdicts, strict=True)):
        growth = band([verdict.growth.per_revolution for verdict in drawn])
        shares = np.mean([(verdict.divergent, verdict.saturating) for verdict in drawn], axis=0)
        yield {
            **vars(coating.case),
            "f_omega": coating.f_omega[places[index]],
            "growth_per_revolution": drawn[0].growth.per_revolution,
            "draws": len(drawn),
            **dict.fromkeys(JUDGED_COLUMNS, math.nan),
            **(dict(zip(JUDGED_COLUMNS, (*shares, *growth), strict=True)) if followed[index] else {}),
            **{f"max_wear_{end}": value for end, value in band(max_wear[:, index])._asdict().items()},
            "lobes_lowest": int(lobes[:, index].min()),
            "lobes_highest": int(lobes[:, index].max()),
            "max_wear_error": ERROR * abs(ensemble.refined.max_wear[index] - max_wear[0, index]),
        }


def of_findings(
    config: Config,
    table: pd.DataFrame,
    rom_accuracy: pd.DataFrame,
    maps: Sequence[CoatingMap],
    ensembles: Sequence[Ensemble],
) -> pd.DataFrame:
    """Judge every claim of the `table` of findings on each draw but the first, the study itself."""
    claims = [claim for claim in findings.CLAIMS if claim.id in set(table["id"])]
    keys = ["casing", "E", "K", "theta", "law", "f_omega"]
    runs = plain(divergence.table(config, maps)).set_index(keys)

    def verdicts(replacing: Sequence[CoatingMap]) -> np.ndarray:
        study, rows = with_runs(maps, ensembles, replacing), runs.copy()
        drawn = plain(divergence.table(config, replacing)).set_index(keys)
        rows.loc[drawn.index] = drawn
        tables = {"peaks": peaks.table(config, study), "divergence": rows.reset_index()}
        tables["rom_accuracy"] = rom_accuracy
        judged = findings.judge(Evidence(config, tables, study), claims)
        return judged.set_index("id").holds.reindex(table["id"]).to_numpy()

    agreements = [verdicts(members) == table.holds.to_numpy() for members in draws(ensembles)]
    refined = [ensemble.refined for ensemble in ensembles]
    return table[["id", "holds"]].assign(
        draws=len(agreements),
        share_of_draws=np.mean(agreements, axis=0) if agreements else math.nan,
        holds_refined=verdicts(refined) if refined else "",
    )
