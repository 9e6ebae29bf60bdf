"""What an engineer asks of a finished study: where is trouble, how sure is that, and what helps."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from bladerub.blade.accuracy import doubts
from bladerub.extras.report.results import Results
from bladerub.extras.report.words import band, mm, percent, properties, ranges, ranges_in_words, rpm, title
from bladerub.io.provenance import config_digest
from bladerub.study.grid import listed_case
from bladerub.study.orders import excites, peak_orders, used_casings
from bladerub.study.peaks import crossing_speed
from bladerub.study.summary import LARGE_DISPLACEMENT

QUIET = 0.1
"""Share of the highest peak of a coating below which a speed counts as free of interaction."""

_FEW = 3
_WIDE_BAND = 0.05  # of the amplitude, to either side
_ELSEWHERE = 1.05  # times the highest peak, from which on vibration beside the peaks is worth a warning
_ORDERS = range(1, 13)


def shown(results: Results, most: int) -> list[str]:
    """Choose the coatings whose maps are shown: the worst, the best and those with a history."""
    known = results.coatings.amplitude.dropna().index
    histories = [listed_case(entry).name for entry in results.config["analysis"]["histories"]]
    names = dict.fromkeys([*known[:1], *known[-1:], *histories])
    return [name for name in names if name in results.cases][:most]


def overview(results: Results) -> list[str]:
    """Say the worst and the best of all coatings, and how many diverge: a line each."""
    table = results.coatings
    known = table.dropna(subset=["amplitude"])
    if known.empty:
        return ["No coating of the study has a peak on the engine orders at which it looks for one."]
    lines = [f"The highest peak: {_peak(results, known.index[0])}."]
    if len(known) > 1:
        ratio = known.amplitude.iloc[0] / known.amplitude.iloc[-1]
        lines.append(f"The lowest, {ratio:.3g} times lower: {_peak(results, known.index[-1])}.")
    speeds, n = results.runs.rpm, len(results.runs) // len(table)
    limit = mm(results.config["solver"]["displacement_limit"] * results.config["blade"]["length"])
    return [
        *lines,
        f"{(table.divergent_share > 0).sum()} of {len(table)} coatings diverge at some of the {n} speeds "
        f"from {rpm(speeds.min())} to {rpm(speeds.max())} rpm, {(table.unbounded_share > 0).sum()} of them "
        f"until the run ends at the displacement limit of {limit} mm.",
    ]


def named(results: Results) -> list[str]:
    """Name the coatings of which the first section says a sentence: all, or the worst and the best few."""
    names = list(results.coatings.index)
    return names if len(names) <= 2 * _FEW else names[:_FEW] + names[-_FEW:]


def sentence(results: Results, name: str) -> str:
    """Say of one coating where its peaks are, how sure that is, and at which speeds it diverges."""
    peaks, runs = results.peaks[results.peaks.name == name], results.runs[results.runs.name == name]
    parts = []
    for peak in peaks.dropna(subset=["amplitude"]).sort_values("amplitude", ascending=False).itertuples():
        ends = band(peak.amplitude_low, peak.amplitude_high)
        sure = f" (90 % band {ends} mm)" if peak.draws > 1 else ""
        parts.append(f"{mm(peak.amplitude)} mm at {rpm(peak.rpm)} rpm on engine order {peak.order}{sure}")
    text = "; ".join(parts) or "no peak"
    for what, mask in (("diverges", runs.divergent), ("ends at the displacement limit", runs.unbounded)):
        if mask.any():
            where = ranges_in_words(ranges(mask.to_numpy(), runs.rpm.to_numpy()))
            text += f"; {what} at {mask.sum()} of {len(runs)} speeds, {where}"
    return f"{text}{'' if runs.divergent.any() else '; diverges at no speed'}."


def changes(results: Results, names: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """Find, for each coating and each of its properties, the best one that differs in that alone.

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
                yield name, best, f"{'' if key == 'theta' else f'{key}: '}{before} → {after}"


def quiet(results: Results, name: str) -> list[tuple[float, float]]:
    """Find the ranges of speeds (rpm) at which no run of a coating grows or vibrates beyond `QUIET`."""
    runs = results.runs[results.runs.name == name]
    grows = runs.divergent | runs.saturating | runs.unbounded
    calm = ~grows & (runs.response < QUIET * results.coatings.amplitude[name])
    return ranges(calm.to_numpy(), runs.rpm.to_numpy())


def lowest(results: Results) -> Iterator[str]:
    """Say which coating of each casing has the lowest peak, and which of those that never diverge."""
    abradable = [name for name in results.coatings.index if not results.cases[name].is_rigid]
    for casing in used_casings(results.config):
        names = [name for name in abradable if results.cases[name].casing == casing]
        table = results.coatings.loc[names].dropna(subset=["amplitude"])
        calm = table[table.divergent_share == 0]
        for what, part in (("", table), (" of those that diverge at no speed", calm)):
            if len(table) > 1 and len(part):
                best = part.iloc[-1]
                diverges = f"diverges at {percent(best.divergent_share)} % of the speeds"
                yield (
                    f"Lowest peak{what}: {_peak(results, best.name)}; deepest wear {mm(best.deepest)} mm; "
                    f"{diverges if best.divergent_share else 'diverges at no speed'}."
                )


def runs_in_doubt(results: Results) -> dict[str, pd.Series]:
    """Find the runs to read with care, a mask over `Results.runs` for each reason."""
    runs = results.runs
    reasons = {
        f"displacement above {LARGE_DISPLACEMENT:.0%} of the blade length": runs.displacement
        >= LARGE_DISPLACEMENT * results.config["blade"]["length"],
        "ended at the displacement limit": runs.unbounded,
        "chaotic: other starts have another verdict": runs.divergent_draws.between(0, 1, "neither"),
        "contact forces not converged": runs.unconverged > 0,
        "energy not balanced": runs.unbalanced > 0,
    }
    return {reason: mask for reason, mask in reasons.items() if mask.any()}


def warnings(results: Results) -> list[str]:
    """Say what makes the results doubtful, and what the study did not look at."""
    nominal = results.config["figures"].get("nominal_speed")
    blade = (f"Blade: {doubt}." for doubt in doubts(results.accuracy, nominal))
    return [*blade, *_of_files(results), *_of_peaks(results), *_elsewhere(results), *_of_speeds(results)]


def _of_files(results: Results) -> Iterator[str]:
    if results.origin.get("provenance_config_sha256") != config_digest(results.config):
        yield "The tables were made with another config than the one that this page was made with."
    if results.runs.unconverged.isna().any():
        yield "Whether the contact forces converged is not known: manifests of the runs are missing."
    if not (results.peaks.draws > 1).any():
        yield "How sure the peaks are is not known: the study has no ensemble (ensemble.members)."


def _of_peaks(results: Results) -> Iterator[str]:
    for peak in results.peaks.itertuples():
        what = f"engine order {peak.order} of {title(results.config, results.cases[peak.name])}"
        if np.isnan(peak.amplitude):
            yield f"No peak on {what}" + (f": {peak.reason}." if isinstance(peak.reason, str) else ".")
        elif peak.amplitude_high - peak.amplitude_low > 2 * _WIDE_BAND * peak.amplitude:
            ends = band(peak.amplitude_low, peak.amplitude_high)
            yield f"The peak on {what} is chaotic: its band is {ends} mm."


def _elsewhere(results: Results) -> Iterator[str]:
    """Name the coatings that vibrate more beside the peaks than there."""
    runs, highest = results.runs, results.runs.name.map(results.coatings.amplitude)
    beyond = runs[~runs.unbounded & (runs.response > _ELSEWHERE * highest)].sort_values("response")
    for run in beyond.drop_duplicates("name", keep="last").itertuples():
        yield (
            f"{title(results.config, results.cases[run.name])}: vibrates more than at its peaks, "
            f"{mm(run.response)} mm at {rpm(run.rpm)} rpm on order {run.strongest_order:.3g}."
        )


def _of_speeds(results: Results) -> Iterator[str]:
    """Name speeds that the study left out, and the orders whose crossing with the first mode it did."""
    config, speeds = results.config, results.runs.rpm
    ends = f"{rpm(speeds.min())} to {rpm(speeds.max())} rpm"
    nominal = config["figures"].get("nominal_speed")
    if nominal and not speeds.min() <= nominal <= speeds.max():
        yield f"The nominal speed, {rpm(nominal)} rpm, is outside of the speeds of the study, {ends}."
    for casing in used_casings(config):
        coating = results.map(next(name for name, case in results.cases.items() if case.casing == casing))
        sought, entry = peak_orders(config, casing), config["casings"][casing]
        crossings = {
            k: 60 * results.f1_hz * crossing_speed(coating, k)
            for k in _ORDERS
            if k not in sought and excites(entry, k)
        }
        if crossings:
            outside = f"outside of {ends}"
            where = (f"{k} ({outside if np.isnan(at) else f'{rpm(at)} rpm'})" for k, at in crossings.items())
            yield (
                f"Casing {casing} also excites engine orders {', '.join(where)}, in brackets where they meet "
                "the first mode: the study seeks no peak there (peak_orders of the casing)."
            )


def _peak(results: Results, name: str) -> str:
    peak, about = results.coatings.loc[name], title(results.config, results.cases[name])
    return f"{mm(peak.amplitude)} mm at {rpm(peak.rpm)} rpm, engine order {peak.order}, with {about}"
