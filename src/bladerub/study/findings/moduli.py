"""Claims C6 to C9 and part of C12: what E and K do to the peaks, two nodal diameters, θ = 0."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.finding import NO, PARTLY, YES, Finding, NotMeasurable, above, below

CASING, THETA = "2nd", 0.0
"""The coatings of section "Mechanical properties of the abradable coating"."""

SOFTEST, STIFFEST = 0.11, 20.0
"""E_min and E_max of the paper; its statements on cells of (E, K) are on those between."""

CRITICAL_E, CRITICAL_K = 1.1, 0.5
"""The cell where the paper finds the greatest Y4 and Y6."""

HIGH_CELLS = ((1.1, 5.0), (0.5, 0.5), (1.5, 1.0))
"""Other (E, K) with "very high amplitudes" (footnote 8)."""

STIFFENING_FROM = 0.5
"""f4 rises with K for E above this."""

SOFT_HARDENING = 0.1
"""Up to this K the Young modulus hardly matters."""


def y4_greatest(evidence: Evidence) -> Finding:
    """C6a: Y4 is greatest at (E, K) = (1.1, 0.5) (section "Local maxima evolution", Fig. 11)."""
    return _greatest(evidence, "C6a", 4, "Fig. 11")


def y6_greatest(evidence: Evidence) -> Finding:
    """C9a: Y6 is greatest at (E, K) = (1.1, 0.5) (section "Local maxima evolution", Fig. 13)."""
    return _greatest(evidence, "C9a", 6, "Fig. 13")


def _greatest(evidence: Evidence, id_: str, order: int, figure: str) -> Finding:
    ranked = _with_critical_cell(evidence, order).stack().dropna().sort_values(ascending=False)
    relative = ranked / ranked.iloc[0]
    own = relative[CRITICAL_K, CRITICAL_E]
    cells = [f"({e:g}, {k:g}) at {height:.2f}" for (k, e), height in relative.iloc[:3].items()]
    holds, _ = above(own, 1.0, 0.9)
    return Finding(
        id=id_,
        claim=f"Y{order} is greatest at (E, K) = (1.1, 0.5) of {ranked.size} cells: first three ({figure})",
        paper="(1.1, 0.5)",
        measured=f"{', '.join(cells)}; (1.1, 0.5) at {own:.2f}",
        unit="1",
        holds=holds,
        margin=float(own - relative.drop((CRITICAL_K, CRITICAL_E)).max()),
    )


def y4_ridge(evidence: Evidence) -> Finding:
    """C6b: for any K, Y4 is highest at E = 1.1 (section "Local maxima evolution", Fig. 11)."""
    table = _with_critical_cell(evidence, 4)
    table = table[table.count(axis=1) >= 2]
    if table.empty:
        raise NotMeasurable("no K with two E or more in the study")
    share = 100 * float(np.mean(table.idxmax(axis=1) == CRITICAL_E))
    holds, margin = above(share, 100, 50)
    claim = "Y4 is highest at E = 1.1 for any K: share of the K (Fig. 11)"
    return Finding("C6b", claim, 100, share, "%", holds, margin)


def y4_high_cells(evidence: Evidence) -> Finding:
    """C6c: Y4 is very high at three other cells as well (section "Local maxima evolution", footnote 8)."""
    table = _with_critical_cell(evidence, 4)
    lowest = min(_cell(table, *cell) for cell in HIGH_CELLS) / float(table.max(axis=None))
    holds, margin = above(lowest, 0.75, 0.5)
    claim = "Y4 is very high at (1.1, 5), (0.5, 0.5), (1.5, 1): lowest of them over the greatest (footnote 8)"
    return Finding("C6c", claim, "near 1", lowest, "1", holds, margin)


def _with_critical_cell(evidence: Evidence, order: int) -> pd.DataFrame:
    table = _moduli(evidence, order, "amplitude")
    _cell(table, CRITICAL_E, CRITICAL_K)
    return table


def _moduli(evidence: Evidence, order: int, column: str) -> pd.DataFrame:
    table = evidence.moduli(CASING, THETA, order, column)
    table = table.loc[:, (table.columns >= SOFTEST) & (table.columns <= STIFFEST)]
    if table.shape[1] < 2:
        raise NotMeasurable(f"fewer than two E from {SOFTEST:g} to {STIFFEST:g} in the study")
    return table


def _cell(table: pd.DataFrame, young: float, hardening: float) -> float:
    cell = table.reindex(index=[hardening], columns=[young]).iloc[0, 0]
    if np.isnan(cell):
        raise NotMeasurable(f"(E, K) = ({young:g}, {hardening:g}) is not in the study")
    return float(cell)


def f4_rises(evidence: Evidence) -> Finding:
    """C7a: f4 at the highest K exceeds that at the lowest, for all E > 0.5 (Fig. 12, contact stiffening)."""
    return _rises(evidence, "C7a", 4, "Fig. 12")


def f6_rises(evidence: Evidence) -> Finding:
    """C9b: f6 at the highest K exceeds that at the lowest, for all E > 0.5 (Fig. 14)."""
    return _rises(evidence, "C9b", 6, "Fig. 14")


def _rises(evidence: Evidence, id_: str, order: int, figure: str) -> Finding:
    rises = [f_peak.iloc[-1] - f_peak.iloc[0] for f_peak in _stiffening(evidence, order)]
    smallest = float(min(rises))
    holds = YES if smallest > 0 else PARTLY if np.mean(rises) > 0 else NO
    claim = f"f{order} rises from the lowest to the highest K for all E > 0.5: smallest rise ({figure})"
    return Finding(id_, claim, "above 0", smallest, "1", holds, smallest)


def f4_monotonic(evidence: Evidence) -> Finding:
    """C7b: f4 does not fall at any step of K, for E > 0.5 (section "Local maxima evolution", Fig. 12)."""
    return _monotonic(evidence, "C7b", 4, "Fig. 12")


def f6_monotonic(evidence: Evidence) -> Finding:
    """C9c: f6 does not fall at any step of K, for E > 0.5 (section "Local maxima evolution", Fig. 14)."""
    return _monotonic(evidence, "C9c", 6, "Fig. 14")


def _monotonic(evidence: Evidence, id_: str, order: int, figure: str) -> Finding:
    steps = np.concatenate([np.diff(f_peak) for f_peak in _stiffening(evidence, order)])
    share = 100 * float(np.mean(steps >= 0))
    holds, margin = above(share, 100, 75)
    claim = f"f{order} does not fall as K rises, for E > 0.5: share of the steps ({figure})"
    return Finding(id_, claim, 100, share, "%", holds, margin)


def _stiffening(evidence: Evidence, order: int) -> list[pd.Series]:
    """Return f_k over ascending K, for each E above 0.5 that the study has with two K or more."""
    table = _moduli(evidence, order, "f_peak")
    columns = [table[young].dropna() for young in table.columns if young > STIFFENING_FROM]
    columns = [f_peak for f_peak in columns if f_peak.size >= 2]
    if not columns:
        raise NotMeasurable(f"no E above {STIFFENING_FROM:g} with two K or more in the study")
    return columns


def y4_insensitive(evidence: Evidence) -> Finding:
    """C8a: for K ≤ 0.1, Y4 hardly varies with E (section "Local maxima evolution", Fig. 11)."""
    return _amplitude_spread(evidence, "C8a", 4, "Fig. 11")


def y6_insensitive(evidence: Evidence) -> Finding:
    """C9d: for K ≤ 0.1, Y6 hardly varies with E (section "Local maxima evolution", Fig. 13)."""
    return _amplitude_spread(evidence, "C9d", 6, "Fig. 13")


def _amplitude_spread(evidence: Evidence, id_: str, order: int, figure: str) -> Finding:
    table = _soft_hardening(evidence, order, "amplitude")
    spread = float(((table.max(axis=1) - table.min(axis=1)) / table.mean(axis=1)).max())
    holds, margin = below(spread, 0.2, 0.5)
    claim = f"Y{order} hardly varies with E for K <= 0.1: largest range over its mean ({figure})"
    return Finding(id_, claim, "near 0", spread, "1", holds, margin)


def f4_insensitive(evidence: Evidence) -> Finding:
    """C8b: for K ≤ 0.1, f4 hardly varies with E (section "Local maxima evolution", Fig. 12)."""
    return _speed_spread(evidence, "C8b", 4, "Fig. 12")


def f6_insensitive(evidence: Evidence) -> Finding:
    """C9e: for K ≤ 0.1, f6 hardly varies with E (section "Local maxima evolution", Fig. 14)."""
    return _speed_spread(evidence, "C9e", 6, "Fig. 14")


def _speed_spread(evidence: Evidence, id_: str, order: int, figure: str) -> Finding:
    table = _soft_hardening(evidence, order, "f_peak")
    spread = float((table.max(axis=1) - table.min(axis=1)).max())
    holds, margin = below(spread, 0.01, 0.02)
    claim = f"f{order} hardly varies with E for K <= 0.1: largest range ({figure})"
    return Finding(id_, claim, "near 0", spread, "1", holds, margin)


def _soft_hardening(evidence: Evidence, order: int, column: str) -> pd.DataFrame:
    table = _moduli(evidence, order, column)
    table = table.loc[table.index <= SOFT_HARDENING]
    table = table[table.count(axis=1) >= 2]
    if table.empty:
        raise NotMeasurable(f"no K up to {SOFT_HARDENING:g} with two E or more in the study")
    return table


def softer_is_harmless(evidence: Evidence) -> Finding:
    """C12b: below E = 0.11 nothing dangerous happens (section "Local maxima evolution").

    Measured as the share of divergent runs on coatings softer than that.
    """
    table = evidence.divergence
    softer = table[(table.casing == CASING) & (table.theta == THETA) & (table.E < SOFTEST)]
    softer = softer[softer.law == "theta"]
    if softer.empty:
        raise NotMeasurable(f"no coating softer than E = {SOFTEST:g} in the study")
    share = 100 * float(softer.divergent.mean())
    holds, margin = below(share, 0, 5)
    claim = "no dangerous interaction below E = 0.11: share of divergent runs"
    return Finding("C12b", claim, 0, share, "%", holds, margin)
