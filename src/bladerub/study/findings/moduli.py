"""Claims C6 to C9 and C12: what E and K do to the peaks, two nodal diameters, θ = 0."""

import itertools

import numpy as np
import pandas as pd

from bladerub.study import paper
from bladerub.study.findings.claim import NO, PARTLY, YES, Finding, NotMeasurable, above, below, claim, ratio
from bladerub.study.findings.evidence import Evidence

_STIFF = 5.0  # E from which on a stiffer coating should be nearer to the rigid casing
_HIGH = ((1.1, 5.0), (0.5, 0.5), (1.5, 1.0))  # other (E, K) with "very high amplitudes" (footnote 8)
_SECTION = 'section "Local maxima evolution"'


@claim("C6a", f"Y4 is greatest at (E, K) = (1.1, 0.5) ({_SECTION}, Fig. 11)", 4, "Fig. 11")
@claim("C9a", f"Y6 is greatest at (E, K) = (1.1, 0.5) ({_SECTION}, Fig. 13)", 6, "Fig. 13")
def greatest(evidence: Evidence, order: int, figure: str) -> Finding:
    """Rank the coatings by height."""
    ranked = _with_critical(evidence, order).stack().dropna().sort_values(ascending=False)
    relative = ratio(ranked, ranked.iloc[0], f"Y{order}")
    critical = relative[paper.CRITICAL_K, paper.CRITICAL_E]
    margin = float(critical - relative.drop((paper.CRITICAL_K, paper.CRITICAL_E)).max())
    first = [f"({e:g}, {k:g}) at {height:.2f}" for (k, e), height in relative.iloc[:3].items()]
    measured = f"{', '.join(first)}; (1.1, 0.5) at {critical:.2f}"
    text = f"Y{order} is greatest at (E, K) = (1.1, 0.5) of {ranked.size} cells: first three ({figure})"
    return Finding(text, "(1.1, 0.5)", measured, "1", above(critical, 1.0, 0.9)[0], margin)


@claim("C6b", f"for any K, Y4 is highest at E = 1.1 ({_SECTION}, Fig. 11)")
def ridge(evidence: Evidence) -> Finding:
    """Share of the K where that is so."""
    table = _with_critical(evidence, 4)
    table = table[table.count(axis=1) >= 2]
    if table.empty:
        raise NotMeasurable("no K with two E or more in the study")
    share = 100 * float(np.mean(table.idxmax(axis=1) == paper.CRITICAL_E))
    text = "Y4 is highest at E = 1.1 for any K: share of the K (Fig. 11)"
    return Finding(text, 100, share, "%", *above(share, 100, 50))


@claim("C6c", f"Y4 is very high at three other cells as well ({_SECTION}, footnote 8)")
def other_heights(evidence: Evidence) -> Finding:
    """Lowest of the three over the greatest of all."""
    table = _with_critical(evidence, 4)
    lowest = ratio(min(_height(table, *other) for other in _HIGH), float(table.max(axis=None)), "Y4")
    text = "Y4 is very high at (1.1, 5), (0.5, 0.5), (1.5, 1): lowest of them over the greatest (footnote 8)"
    return Finding(text, "near 1", lowest, "1", *above(lowest, 0.75, 0.5))


@claim(
    "C7a",
    "f4 at the highest K exceeds that at the lowest, for all E > 0.5 (Fig. 12, contact stiffening)",
    4,
    "Fig. 12",
)
@claim("C9b", "f6 at the highest K exceeds that at the lowest, for all E > 0.5 (Fig. 14)", 6, "Fig. 14")
def stiffening(evidence: Evidence, order: int, figure: str) -> Finding:
    """Smallest increase of f_k from the lowest to the highest K."""
    increases = [f_peak.iloc[-1] - f_peak.iloc[0] for f_peak in _stiffened(evidence, order)]
    smallest = float(min(increases))
    holds = YES if smallest > 0 else PARTLY if np.mean(increases) > 0 else NO
    text = f"f{order} rises from the lowest to the highest K for all E > 0.5: smallest rise ({figure})"
    return Finding(text, "above 0", smallest, "1", holds, smallest)


@claim("C7b", f"f4 does not fall at any step of K, for E > 0.5 ({_SECTION}, Fig. 12)", 4, "Fig. 12")
@claim("C9c", f"f6 does not fall at any step of K, for E > 0.5 ({_SECTION}, Fig. 14)", 6, "Fig. 14")
def monotonic(evidence: Evidence, order: int, figure: str) -> Finding:
    """Share of the steps where that is so."""
    steps = np.concatenate([np.diff(f_peak) for f_peak in _stiffened(evidence, order)])
    share = 100 * float(np.mean(steps >= 0))
    text = f"f{order} does not fall as K rises, for E > 0.5: share of the steps ({figure})"
    return Finding(text, 100, share, "%", *above(share, 100, 75))


@claim("C8a", f"for K ≤ 0.1, Y4 hardly varies with E ({_SECTION}, Fig. 11)", 4, "Fig. 11")
@claim("C9d", f"for K ≤ 0.1, Y6 hardly varies with E ({_SECTION}, Fig. 13)", 6, "Fig. 13")
def height_varies(evidence: Evidence, order: int, figure: str) -> Finding:
    """Largest range over E, relative to the mean over E."""
    table = _soft_hardening(evidence, order, "amplitude")
    widths, heights = table.max(axis=1) - table.min(axis=1), table.mean(axis=1)
    spread = max(ratio(width, height, f"Y{order}") for width, height in zip(widths, heights, strict=True))
    text = f"Y{order} hardly varies with E for K <= 0.1: largest range over its mean ({figure})"
    return Finding(text, "near 0", spread, "1", *below(spread, paper.HARDLY["amplitude"], 0.5))


@claim("C8b", f"for K ≤ 0.1, f4 hardly varies with E ({_SECTION}, Fig. 12)", 4, "Fig. 12")
@claim("C9e", f"for K ≤ 0.1, f6 hardly varies with E ({_SECTION}, Fig. 14)", 6, "Fig. 14")
def speed_varies(evidence: Evidence, order: int, figure: str) -> Finding:
    """Largest range over E."""
    table = _soft_hardening(evidence, order, "f_peak")
    spread = float((table.max(axis=1) - table.min(axis=1)).max())
    text = f"f{order} hardly varies with E for K <= 0.1: largest range ({figure})"
    return Finding(text, "near 0", spread, "1", *below(spread, paper.HARDLY["f_peak"], 0.02))


def _moduli(evidence: Evidence, order: int, column: str) -> pd.DataFrame:
    """Return Y_k or f_k over K (rows) and the paper's range of E (columns)."""
    table = evidence.moduli(paper.CASING, paper.THETA, order, column)
    table = table.loc[:, (table.columns >= paper.SOFTEST) & (table.columns <= paper.STIFFEST)]
    if table.shape[1] < 2:
        raise NotMeasurable(f"fewer than two E from {paper.SOFTEST:g} to {paper.STIFFEST:g} in the study")
    return table


def _with_critical(evidence: Evidence, order: int) -> pd.DataFrame:
    table = _moduli(evidence, order, "amplitude")
    _height(table, paper.CRITICAL_E, paper.CRITICAL_K)
    return table


def _height(table: pd.DataFrame, young: float, hardening: float) -> float:
    height = table.reindex(index=[hardening], columns=[young]).iloc[0, 0]
    if np.isnan(height):
        raise NotMeasurable(f"(E, K) = ({young:g}, {hardening:g}) is not in the study, or has no peak")
    return float(height)


def _stiffened(evidence: Evidence, order: int) -> list[pd.Series]:
    """Return f_k over ascending K, for each E above 0.5 that the study has with two K or more."""
    table = _moduli(evidence, order, "f_peak")
    table = table.loc[:, (table.columns > paper.STIFFENING_FROM) & (table.count() >= 2)]
    if table.empty:
        raise NotMeasurable(f"no E above {paper.STIFFENING_FROM:g} with two K or more in the study")
    return [table[young].dropna() for young in table]


def _soft_hardening(evidence: Evidence, order: int, column: str) -> pd.DataFrame:
    """Return Y_k or f_k for the lowest K, where the study has two E or more."""
    table = _moduli(evidence, order, column)
    table = table[(table.index <= paper.SOFT_HARDENING) & (table.count(axis=1) >= 2)]
    if table.empty:
        raise NotMeasurable(f"no K up to {paper.SOFT_HARDENING:g} with two E or more in the study")
    return table


@claim(
    "C12a", 'above E = 20 contact is as with the rigid casing ("Local maxima evolution", end of paragraph 2)'
)
def stiff_is_rigid(evidence: Evidence) -> Finding:
    """How far Y4, f4, Y6 and f6 lie from those of the rigid casing, each in units of `paper.HARDLY`.

    The largest of the four is the distance. K is the highest of the study, because a high E alone makes a
    coating rigid-plastic, not rigid. The claim holds if the stiffest E is within a distance of 1 and no
    softer one from E = 5 on is nearer; partly, if one is so. The margin is what is left to the first limit.
    """
    keys = itertools.product(paper.ORDERS, paper.HARDLY)
    peaks = pd.DataFrame({key: _offset(evidence, *key) for key in keys}).dropna()  # coatings with all four
    peaks = peaks[peaks.index.get_level_values("K") == peaks.index.get_level_values("K").max()].droplevel("K")
    if peaks.shape[0] < 2 or peaks.index[-1] < paper.STIFFEST:
        raise NotMeasurable(f"at the highest K no two E from {_STIFF:g}, one from {paper.STIFFEST:g} on")
    distance = (peaks.abs() / [paper.HARDLY[column] for _, column in peaks]).max(axis=1).round(9)
    stiffest, softer = distance.iloc[-1], distance.iloc[:-1]
    close, nearest = stiffest <= 1, stiffest <= softer.min()
    offsets = [
        f"Y{order} {offset:+.0%}" if column == "amplitude" else f"f{order} {offset:+.3f}"
        for (order, column), offset in peaks.iloc[-1].items()
    ]
    softer_one = "none softer is nearer" if nearest else f"E = {softer.idxmin():g} is nearer"
    measured = f"{', '.join(offsets)}; {softer_one}"
    holds = YES if close and nearest else PARTLY if close or nearest else NO
    text = f"above E = 20 contact is as with the rigid casing: offset at E = {distance.index[-1]:g}"
    return Finding(text, "near 0", measured, "1", holds, float(min(1.0, softer.min()) - stiffest))


def _offset(evidence: Evidence, order: int, column: str) -> pd.Series:
    """Return by what Y_k (relative) or f_k exceeds that of the rigid casing, over K and the stiff E."""
    rigid = evidence.peak(paper.RIGID, order, column)
    table = evidence.moduli(paper.CASING, paper.THETA, order, column)
    stiff = table.loc[:, table.columns >= _STIFF].stack()
    return ratio(stiff, rigid, paper.RIGID.name) - 1 if column == "amplitude" else stiff - rigid


@claim("C12b", 'below E = 0.11 nothing dangerous happens (section "Local maxima evolution")')
def softer_is_harmless(evidence: Evidence) -> Finding:
    """Share of divergent runs on softer coatings."""
    table = evidence.divergence
    plain = (table.casing == paper.CASING) & (table.theta == paper.THETA) & (table.law == "theta")
    softer = table[plain & (table.E < paper.SOFTEST)]
    if softer.empty:
        raise NotMeasurable(f"no coating softer than E = {paper.SOFTEST:g} in the study")
    share = 100 * float(softer.divergent.mean())
    text = "no dangerous interaction below E = 0.11: share of divergent runs"
    return Finding(text, 0, share, "%", *below(share, 0, 5))


@claim("C12c", 'a coating may raise Y4 above direct contact ("Conclusion", Fig. 11)', 4, "Fig. 11")
@claim("C12d", 'a coating may raise Y6 above direct contact ("Conclusion", Fig. 13)', 6, "Fig. 13")
def worse_than_rigid(evidence: Evidence, order: int, figure: str) -> Finding:
    """Greatest height of a coating over that of the rigid casing."""
    rigid = evidence.peak(paper.RIGID, order, "amplitude")
    highest = ratio(float(_moduli(evidence, order, "amplitude").max(axis=None)), rigid, paper.RIGID.name)
    text = f"a coating may raise Y{order} above that of the rigid casing: greatest ratio ({figure})"
    return Finding(text, "above 1", highest, "1", *above(highest, 1, 1))
