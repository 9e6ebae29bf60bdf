"""What an engineer asks of a finished study: where is trouble, how sure is that, and what helps.

Quantities are written in the units of an engineer.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from bladerub.extras.report.results import Results
from bladerub.settings.study import Config
from bladerub.settings.units import pressure_in_words
from bladerub.study.grid import CoatingCase, listed_case, modulus_unit, run_spec
from bladerub.study.peaks import crossing_speed, excites, peak_orders, used_casings
from bladerub.study.summary import LARGE_DISPLACEMENT

NONE = "–"  # a quantity that is not known
_FINEST = 1e-4  # mm
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
    """Yield a coating, the best that differs in one property alone if its peak is lower, and what changes."""
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
    """Yield the coating of each casing with the lowest peak, and that of those that diverge at no speed."""
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


def mm(length: float, digits: int = 3) -> str:
    """Write a length (m) in mm."""
    if math.isnan(length):
        return NONE
    return f"below {_FINEST}" if 0 < 1e3 * length < _FINEST else f"{1e3 * length:.{digits}g}"


def rpm(speed: float) -> str:
    """Write a speed in rpm, whole."""
    return NONE if math.isnan(speed) else f"{speed:,.0f}"


def percent(share: float) -> str:
    """Write a share in percent."""
    return f"{100 * share:.2g}" if share < 0.995 else "100"


def band(low: float, high: float) -> str:
    """Write the ends of a band (m) in mm, to four digits: most bands are narrow."""
    return NONE if math.isnan(low + high) else f"{mm(low, 4)} to {mm(high, 4)}"


def properties(config: Config, case: CoatingCase) -> dict[str, str]:
    """Write casing, moduli and direction of the force of a coating, each with its unit."""
    modulus = {
        key: "rigid" if case.is_rigid else pressure_in_words(modulus_unit(config) * getattr(case, key))
        for key in ("E", "K")
    }
    force = f"θ = {math.degrees(case.theta):.3g}°" if case.law == "theta" else f"μ = {case.friction:.3g}"
    return {"casing": case.casing, **modulus, "theta": force}


def title(config: Config, case: CoatingCase) -> str:
    """Name a coating by its properties, and by what it has of its own."""
    about, spec = properties(config, case), run_spec(config, case, 0.0)
    layer = "rigid" if case.is_rigid else f"E = {about['E']}, K = {about['K']}"
    own = {
        "damping_ratio": f"damping ratio {percent(spec.damping_ratio)} %",
        "layer_thickness": f"layer {mm(spec.coating.thickness)} mm",
        "interference": f"interference {mm(spec.casing.interference)} mm",
    }
    return ", ".join([f"casing {case.casing}", layer, about["theta"], *(own[key] for key in case.own)])


def ranges(mask: np.ndarray, speeds: np.ndarray, most: int = 3) -> str:
    """Write the ranges of ascending `speeds` (n,), rpm, with a true `mask` (n,): the widest, and the ends."""
    steps = np.diff(np.concatenate([[0], np.asarray(mask, dtype=int), [0]]))
    starts, ends = np.flatnonzero(steps == 1), np.flatnonzero(steps == -1) - 1
    parts = list(zip(speeds[starts].tolist(), speeds[ends].tolist(), strict=True))
    widest = sorted(sorted(parts, key=lambda part: part[0] - part[1])[:most])
    text = ", ".join(_range(*part) for part in widest)
    if len(parts) > most:
        text += f" and {len(parts) - most} more within {_range(parts[0][0], parts[-1][1])}"
    return text or NONE


def _range(low: float, high: float) -> str:
    return rpm(low) if low == high else f"{rpm(low)} to {rpm(high)}"
