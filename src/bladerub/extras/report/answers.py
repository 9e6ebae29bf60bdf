"""What an engineer asks of a finished study: where is trouble, how sure is that, and what helps."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import pandas as pd

from bladerub.extras.report.results import Results
from bladerub.extras.report.words import properties, ranges
from bladerub.study.grid import listed_case
from bladerub.study.peaks import crossing_speed, excites, peak_orders, used_casings
from bladerub.study.summary import LARGE_DISPLACEMENT

QUIET = 0.1  # of the highest peak of a coating, below which a speed counts as free of interaction
WIDE_BAND = 0.1  # of the amplitude of a peak, from which on it counts as chaotic
_ELSEWHERE = 1.05  # times the highest peak, from which on vibration beside the peaks is worth a warning


def shown(results: Results, most: int) -> list[str]:
    """Choose the coatings whose maps are shown: the worst, the best and those with a history."""
    known = results.coatings.amplitude.dropna().index
    histories = [listed_case(entry).name for entry in results.config.analysis.histories]
    names = dict.fromkeys([*known[:1], *known[-1:], *histories])
    return [name for name in names if name in results.cases][:most]


def changes(results: Results, names: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """Find the best coating that differs in one property alone, for each coating and property.

    Yields both names and what changes, where the highest peak is lower.
    """
    heights, cases = results.coatings.amplitude, results.cases
    for name in names:
        for key in () if cases[name].is_rigid else ("casing", "E", "K", "theta"):
            kept = {key: getattr(cases[name], key)}
            others = [other for other in heights.index if replace(cases[other], **kept) == cases[name]]
            best = heights[others].idxmin() if heights[others].notna().any() else name
            if heights[best] < heights[name]:
                before, after = (properties(results.config, cases[coating])[key] for coating in (name, best))
                yield name, best, (f"{'' if key == 'theta' else f'{key}: '}{before} → {after}")


def quiet(results: Results, name: str) -> str:
    """Say at which speeds (rpm) no run of a coating grows or vibrates beyond `QUIET`."""
    runs = results.runs[results.runs.name == name]
    calm = runs.response < QUIET * results.coatings.amplitude[name]
    calm &= ~(runs.divergent | runs.saturating | runs.unbounded)
    return ranges(calm.to_numpy(), runs.rpm.to_numpy(), 5)


def lowest(results: Results) -> Iterator[tuple[str, pd.Series]]:
    """Find the coating of each casing with the lowest peak, and that of those that never diverge.

    Yields what it is the lowest of, and its row of `Results.coatings`.
    """
    for casing in used_casings(results.config):
        cases = results.coatings.name.map(results.cases)
        table = results.coatings[[case.casing == casing and not case.is_rigid for case in cases]]
        table = table.dropna(subset=["amplitude"])
        calm = table[table.divergent_share == 0]
        if len(table) > 1:
            yield "", table.iloc[-1]
            if len(calm) and table.divergent_share.iloc[-1]:
                yield " of those that diverge at no speed", calm.iloc[-1]


def doubtful(results: Results) -> pd.DataFrame:
    """Count the runs of each coating to read with care, a column for each reason that occurs."""
    runs = results.runs
    reasons = {
        f"radial displacement of node 1 above {LARGE_DISPLACEMENT:.0%} of the blade length": runs.displacement
        >= LARGE_DISPLACEMENT * results.config.blade.length,
        "ended at the displacement limit": runs.unbounded,
        "chaotic: other starts have another verdict": runs.divergent_draws.between(0, 1, "neither"),
        "contact forces not converged": runs.unconverged > 0,
        "energy not balanced": runs.unbalanced > 0,
    }
    counts = pd.DataFrame(reasons).groupby(runs.name).sum().astype(int)
    return counts.loc[counts.any(axis=1), counts.any()].rename(columns="{} (runs)".format)


def elsewhere(results: Results) -> pd.DataFrame:
    """Find the coatings that vibrate more beside the peaks than there: their runs that do so most."""
    runs, highest = results.runs, results.runs.name.map(results.coatings.amplitude)
    beyond = runs[~runs.unbounded & (runs.response > _ELSEWHERE * highest)].sort_values("response")
    return beyond.drop_duplicates("name", keep="last")


def unsought(results: Results) -> Iterator[tuple[str, dict[int, float]]]:
    """Find casings, and rpm (NaN: outside) where orders on which the study seeks no peak cross mode 1."""
    for casing in used_casings(results.config):
        coating = results.map(next(name for name, case in results.cases.items() if case.casing == casing))
        sought, entry = peak_orders(results.config, casing), results.config.casings[casing]
        orders = [order for order in range(1, 13) if order not in sought and excites(entry, order)]
        if orders:
            yield casing, {order: 60 * results.f1_hz * crossing_speed(coating, order) for order in orders}
