"""Part of claim C12: a stiff coating acts like the bare rigid casing, two nodal diameters, θ = 0."""

from __future__ import annotations

import pandas as pd

from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.finding import NO, PARTLY, YES, Finding, NotMeasurable
from bladerub.study.findings.moduli import CASING, THETA
from bladerub.study.grid import CoatingCase

RIGID = CoatingCase.rigid(CASING, friction=0.0)
"""Direct contact of the blade with the casing."""

STIFF, STIFFEST = 5.0, 20.0
"""E from which on a stiffer coating should be nearer to the rigid casing, and E_max of the paper."""

ORDERS = (4, 6)
"""Engine orders of the peaks that are compared."""

HARDLY = {"amplitude": 0.2, "f_peak": 0.01}
"""Differences that C8 and C9 call hardly any: of Y relative, of f normalised."""


def stiff_is_rigid(evidence: Evidence) -> Finding:
    """C12a: above E = 20 contact is as with the rigid casing ("Local maxima evolution", end of paragraph 2).

    Measured as how far Y4, f4, Y6 and f6 lie from those of the rigid casing, each in units of what counts as
    hardly a difference; the largest of the four is the distance. K is the highest of the study, because a
    high E alone makes a coating rigid-plastic, not rigid.

    The claim holds if the stiffest E is within a distance of 1 and no softer one from E = 5 on is nearer;
    partly, if only one of these is so. The margin is the distance that is left to the first border.
    """
    peaks = {(order, column): _offset(evidence, order, column) for order in ORDERS for column in HARDLY}
    scaled = {key: offset.abs() / HARDLY[key[1]] for key, offset in peaks.items()}
    distance = pd.DataFrame(scaled).max(axis=1)
    stiffest, softer = distance.iloc[-1], distance.iloc[:-1]
    close, nearest = stiffest <= 1, stiffest <= softer.min()
    offsets = [
        f"Y{order} {offset.iloc[-1]:+.0%}" if column == "amplitude" else f"f{order} {offset.iloc[-1]:+.3f}"
        for (order, column), offset in peaks.items()
    ]
    softer_one = "none softer is nearer" if nearest else f"E = {softer.idxmin():g} is nearer"
    return Finding(
        id="C12a",
        claim=f"above E = 20 contact is as with the rigid casing: offset at E = {distance.index[-1]:g}",
        paper="near 0",
        measured=f"{', '.join(offsets)}; {softer_one}",
        unit="1",
        holds=YES if close and nearest else PARTLY if close or nearest else NO,
        margin=float(min(1.0, softer.min()) - stiffest),
    )


def _offset(evidence: Evidence, order: int, column: str) -> pd.Series:
    """Return by what Y_k (relative) or f_k exceeds that of the rigid casing, over the stiff E, ascending."""
    rigid = evidence.peak(RIGID, order, column)
    stiff = evidence.moduli(CASING, THETA, order, column).iloc[-1].dropna()
    stiff = stiff[stiff.index >= STIFF]
    if stiff.size < 2 or stiff.index[-1] < STIFFEST:
        raise NotMeasurable(f"at the highest K no E from {STIFFEST:g} on beside one from {STIFF:g} on")
    return stiff / rigid - 1 if column == "amplitude" else stiff - rigid
