"""Claims C10 and C11: what the tangential force of θ = 0.15 rad does, E = 2, K = 0.5."""

from __future__ import annotations

import pandas as pd

from bladerub.study.findings.evidence import Evidence
from bladerub.study.findings.finding import NO, PARTLY, YES, Finding, NotMeasurable, below
from bladerub.study.grid import CoatingCase

STRAIGHT = CoatingCase("2nd", 2.0, 0.5, 0.0)
"""The coating of Fig. 15."""

TILTED = CoatingCase("2nd", 2.0, 0.5, 0.15)
"""The coating of Fig. 16."""

TILTED_SPEED, STRAIGHT_SPEED = 0.190, 0.197
"""Where the paper sees divergence with θ = 0.15 and with θ = 0 (Figs. 17 and 18)."""

LOBES = 6
"""Worn lobes of both divergent runs (Fig. 19)."""


def lower_y4(evidence: Evidence) -> Finding:
    """C10a: θ = 0.15 lowers Y4 (section "Influence of parameter θ", Figs. 15 and 16)."""
    return _lower_amplitude(evidence, "C10a", 4)


def lower_y6(evidence: Evidence) -> Finding:
    """C10b: θ = 0.15 lowers Y6 (section "Influence of parameter θ", Figs. 15 and 16)."""
    return _lower_amplitude(evidence, "C10b", 6)


def _lower_amplitude(evidence: Evidence, id_: str, order: int) -> Finding:
    ratio = evidence.peak(TILTED, order, "amplitude") / evidence.peak(STRAIGHT, order, "amplitude")
    holds, margin = below(ratio, 1.0, 1.05)
    claim = f"theta = 0.15 lowers Y{order}: ratio to theta = 0 (Figs. 15 and 16)"
    return Finding(id_, claim, "below 1", ratio, "1", holds, margin)


def lower_f4(evidence: Evidence) -> Finding:
    """C10c: θ = 0.15 lowers f4 (section "Influence of parameter θ", Figs. 15 and 16)."""
    return _lower_speed(evidence, "C10c", 4)


def lower_f6(evidence: Evidence) -> Finding:
    """C10d: θ = 0.15 lowers f6 (section "Influence of parameter θ", Figs. 15 and 16; 0.197 to 0.190)."""
    return _lower_speed(evidence, "C10d", 6)


def _lower_speed(evidence: Evidence, id_: str, order: int) -> Finding:
    shift = evidence.peak(TILTED, order, "f_peak") - evidence.peak(STRAIGHT, order, "f_peak")
    holds = YES if shift < 0 else PARTLY if shift == 0 else NO  # equal: less than a speed step
    claim = f"theta = 0.15 lowers f{order}: shift from theta = 0 (Figs. 15 and 16)"
    paper = TILTED_SPEED - STRAIGHT_SPEED if order == LOBES else "below 0"
    return Finding(id_, claim, paper, shift, "1", holds, -shift)


def tilted_diverges(evidence: Evidence) -> Finding:
    """C11a: θ = 0.15 diverges at f_Ω = 0.190 (section "Influence of parameter θ", Fig. 17)."""
    return _diverges(evidence, "C11a", TILTED, TILTED_SPEED, "Fig. 17")


def straight_diverges(evidence: Evidence) -> Finding:
    """C11b: θ = 0 diverges at f_Ω = 0.197 (section "Influence of parameter θ", Fig. 18)."""
    return _diverges(evidence, "C11b", STRAIGHT, STRAIGHT_SPEED, "Fig. 18")


def straight_is_steady(evidence: Evidence) -> Finding:
    """C11c: θ = 0 does not diverge at f_Ω = 0.190 (section "Influence of parameter θ", Fig. 17)."""
    return _is_steady(evidence, "C11c", STRAIGHT, TILTED_SPEED, "Fig. 17")


def tilted_is_steady(evidence: Evidence) -> Finding:
    """C11d: θ = 0.15 does not diverge at f_Ω = 0.197 (section "Influence of parameter θ", Fig. 18)."""
    return _is_steady(evidence, "C11d", TILTED, STRAIGHT_SPEED, "Fig. 18")


def tilted_lobes(evidence: Evidence) -> Finding:
    """C11e: six worn lobes with θ = 0.15 at f_Ω = 0.190 (section "Influence of parameter θ", Fig. 19(a))."""
    return _six_lobes(evidence, "C11e", TILTED, TILTED_SPEED, "Fig. 19(a)")


def straight_lobes(evidence: Evidence) -> Finding:
    """C11f: six worn lobes with θ = 0 at f_Ω = 0.197 (section "Influence of parameter θ", Fig. 19(b))."""
    return _six_lobes(evidence, "C11f", STRAIGHT, STRAIGHT_SPEED, "Fig. 19(b)")


def tilted_diverges_at_own_peak(evidence: Evidence) -> Finding:
    """C11g: as C11a, at the speed where this model has f6 with θ = 0.15."""
    return _diverges(evidence, "C11g", TILTED, evidence.peak(TILTED, LOBES, "f_peak"), "our f6")


def straight_diverges_at_own_peak(evidence: Evidence) -> Finding:
    """C11h: as C11b, at the speed where this model has f6 with θ = 0."""
    return _diverges(evidence, "C11h", STRAIGHT, evidence.peak(STRAIGHT, LOBES, "f_peak"), "our f6")


def straight_is_steady_at_tilted_peak(evidence: Evidence) -> Finding:
    """C11i: as C11c, at the speed where this model has f6 with θ = 0.15."""
    return _is_steady(evidence, "C11i", STRAIGHT, _distinct_peak(evidence, TILTED), "our f6 of theta = 0.15")


def tilted_is_steady_at_straight_peak(evidence: Evidence) -> Finding:
    """C11j: as C11d, at the speed where this model has f6 with θ = 0."""
    return _is_steady(evidence, "C11j", TILTED, _distinct_peak(evidence, STRAIGHT), "our f6 of theta = 0")


def tilted_lobes_at_own_peak(evidence: Evidence) -> Finding:
    """C11k: as C11e, at the speed where this model has f6 with θ = 0.15."""
    return _six_lobes(evidence, "C11k", TILTED, evidence.peak(TILTED, LOBES, "f_peak"), "our f6")


def straight_lobes_at_own_peak(evidence: Evidence) -> Finding:
    """C11l: as C11f, at the speed where this model has f6 with θ = 0."""
    return _six_lobes(evidence, "C11l", STRAIGHT, evidence.peak(STRAIGHT, LOBES, "f_peak"), "our f6")


def _distinct_peak(evidence: Evidence, case: CoatingCase) -> float:
    speeds = {each.theta: evidence.peak(each, LOBES, "f_peak") for each in (STRAIGHT, TILTED)}
    if len(set(speeds.values())) == 1:
        raise NotMeasurable("f6 is the same speed of the grid with and without theta: a finer step tells")
    return speeds[case.theta]


def _diverges(evidence: Evidence, id_: str, case: CoatingCase, f_omega: float, where: str) -> Finding:
    run, threshold = evidence.run(case, f_omega), evidence.config["analysis"]["divergence"]["growth"]
    surely = _growth(run, "growth_low")
    # growth that ends after the paper's revolutions, or that the scatter hides, is half of the claim
    hidden = run.growth_per_revolution > threshold >= surely
    holds = YES if run.divergent else PARTLY if run.saturating or hidden else NO
    claim = f"theta = {case.theta:g} diverges at f_omega = {f_omega:g}: growth a revolution ({where})"
    growth = _growth(run, "growth_per_revolution")
    return Finding(id_, claim, f"surely above {threshold:g}", growth, "1", holds, surely - threshold)


def _is_steady(evidence: Evidence, id_: str, case: CoatingCase, f_omega: float, where: str) -> Finding:
    run, threshold = evidence.run(case, f_omega), evidence.config["analysis"]["divergence"]["growth"]
    holds = NO if run.divergent else PARTLY if run.saturating else YES
    claim = f"theta = {case.theta:g} does not diverge at f_omega = {f_omega:g}: growth a revolution ({where})"
    growth, margin = _growth(run, "growth_per_revolution"), threshold - _growth(run, "growth_low")
    return Finding(id_, claim, f"not surely above {threshold:g}", growth, "1", holds, margin)


def _growth(run: pd.Series, column: str) -> float:
    # a run that left all bounds has grown beyond measure, whatever a fit to what it left says
    return float("inf") if run.status == "unbounded" else float(run[column])


def _six_lobes(evidence: Evidence, id_: str, case: CoatingCase, f_omega: float, where: str) -> Finding:
    count = int(evidence.run(case, f_omega).lobes)
    holds, margin = below(abs(count - LOBES), 0, 1)
    claim = f"six worn lobes with theta = {case.theta:g} at f_omega = {f_omega:g} ({where})"
    return Finding(id_, claim, LOBES, count, "1", holds, margin)
