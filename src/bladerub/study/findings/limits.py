"""Claim C12: stiff coatings act like the bare rigid casing, soft ones are harmless; two diameters, θ = 0."""

import pandas as pd

from bladerub.study.findings.claim import NO, PARTLY, YES, Finding, NotMeasurable, below, claim, ratio
from bladerub.study.findings.evidence import Evidence
from bladerub.study.paper import CASING, HARDLY, RIGID, SOFTEST, STIFFEST, THETA

_STIFF = 5.0  # E from which on a stiffer coating should be nearer to the rigid casing
_ORDERS = (4, 6)


@claim(
    "C12a", 'above E = 20 contact is as with the rigid casing ("Local maxima evolution", end of paragraph 2)'
)
def stiff_is_rigid(evidence: Evidence) -> Finding:
    """How far Y4, f4, Y6 and f6 lie from those of the rigid casing, each in units of `HARDLY`.

    The largest of the four is the distance. K is the highest of the study, because a high E alone makes a
    coating rigid-plastic, not rigid. The claim holds if the stiffest E is within a distance of 1 and no
    softer one from E = 5 on is nearer; partly, if only one of these is so. The margin is the distance that is
    left to the first border.
    """
    peaks = {(order, column): _offset(evidence, order, column) for order in _ORDERS for column in HARDLY}
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
    stiff = stiff[stiff.index >= _STIFF]
    if stiff.size < 2 or stiff.index[-1] < STIFFEST:
        raise NotMeasurable(f"at the highest K no E from {STIFFEST:g} on and another from {_STIFF:g} on")
    if column == "amplitude":
        return stiff.map(lambda height: ratio(height, rigid, RIGID.name) - 1)
    return stiff - rigid


@claim("C12b", 'below E = 0.11 nothing dangerous happens (section "Local maxima evolution")')
def softer_is_harmless(evidence: Evidence) -> Finding:
    """Share of divergent runs on softer coatings."""
    table = evidence.divergence
    softer = table[(table.casing == CASING) & (table.theta == THETA) & (table.E < SOFTEST)]
    softer = softer[softer.law == "theta"]
    if softer.empty:
        raise NotMeasurable(f"no coating softer than E = {SOFTEST:g} in the study")
    share = 100 * float(softer.divergent.mean())
    text = "no dangerous interaction below E = 0.11: share of divergent runs"
    return Finding(text, 0, share, "%", *below(share, 0, 5))
