"""Claims C10 and C11: what the tangential force of θ = 0.15 rad does, E = 2, K = 0.5."""

import pandas as pd

from bladerub.study.findings.claim import NO, PARTLY, YES, Finding, NotMeasurable, below, claim, ratio
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase
from bladerub.study.paper import STRAIGHT, STRAIGHT_SPEED, TILTED, TILTED_SPEED

_LOBES = 6  # worn lobes of both divergent runs (Fig. 19), so their engine order too
_PAPER_F6_SHIFT = TILTED_SPEED - STRAIGHT_SPEED
_HISTORIES = {TILTED_SPEED: "Fig. 17", STRAIGHT_SPEED: "Fig. 18"}
_PATTERNS = {TILTED: "Fig. 19(a)", STRAIGHT: "Fig. 19(b)"}
_SECTION = 'section "Influence of parameter θ"'
_AT_TILTED_PEAK = "at the speed where this model has f6 with θ = 0.15"
_AT_STRAIGHT_PEAK = "at the speed where this model has f6 with θ = 0"


@claim("C10a", f"θ = 0.15 lowers Y4 ({_SECTION}, Figs. 15 and 16)", 4)
@claim("C10b", f"θ = 0.15 lowers Y6 ({_SECTION}, Figs. 15 and 16)", 6)
def lower_amplitude(evidence: Evidence, order: int) -> Finding:
    """Ratio of the heights of the peaks."""
    tilted, straight = (evidence.peak(case, order, "amplitude") for case in (TILTED, STRAIGHT))
    lowered = ratio(tilted, straight, STRAIGHT.name)
    text = f"theta = 0.15 lowers Y{order}: ratio to theta = 0 (Figs. 15 and 16)"
    return Finding(text, "below 1", lowered, "1", *below(lowered, 1.0, 1.05))


@claim("C10c", f"θ = 0.15 lowers f4 ({_SECTION}, Figs. 15 and 16)", 4, "below 0")
@claim("C10d", f"θ = 0.15 lowers f6 ({_SECTION}, Figs. 15 and 16; 0.197 to 0.190)", 6, _PAPER_F6_SHIFT)
def lower_speed(evidence: Evidence, order: int, paper: float | str) -> Finding:
    """Shift of the speed of the peak; none is less than a speed step."""
    shift = evidence.peak(TILTED, order, "f_peak") - evidence.peak(STRAIGHT, order, "f_peak")
    holds = YES if shift < 0 else PARTLY if shift == 0 else NO
    text = f"theta = 0.15 lowers f{order}: shift from theta = 0 (Figs. 15 and 16)"
    return Finding(text, paper, shift, "1", holds, -shift)


@claim("C11a", f"θ = 0.15 diverges at f_Ω = 0.190 ({_SECTION}, Fig. 17)", TILTED, TILTED_SPEED)
@claim("C11b", f"θ = 0 diverges at f_Ω = 0.197 ({_SECTION}, Fig. 18)", STRAIGHT, STRAIGHT_SPEED)
@claim("C11g", f"as C11a, {_AT_TILTED_PEAK}", TILTED)
@claim("C11h", f"as C11b, {_AT_STRAIGHT_PEAK}", STRAIGHT)
def diverges(evidence: Evidence, case: CoatingCase, speed: float | None = None) -> Finding:
    """Growth of the run at `speed`, at this model's f6 if there is none."""
    f_omega = evidence.peak(case, _LOBES, "f_peak") if speed is None else speed
    run, threshold = evidence.run(case, f_omega), evidence.config.analysis.divergence.growth
    surely = _growth(run, "growth_low")
    # growth that ends after the paper's revolutions, or that the scatter hides, is half of the claim
    hidden = run.growth_per_revolution > threshold >= surely
    holds = YES if run.divergent else PARTLY if run.saturating or hidden else NO
    source = _HISTORIES.get(speed, "our f6")
    text = f"theta = {case.theta:g} diverges at f_omega = {f_omega:g}: growth a revolution ({source})"
    growth = _growth(run, "growth_per_revolution")
    return Finding(text, f"surely above {threshold:g}", growth, "1", holds, surely - threshold)


@claim("C11c", f"θ = 0 does not diverge at f_Ω = 0.190 ({_SECTION}, Fig. 17)", STRAIGHT, TILTED_SPEED)
@claim("C11d", f"θ = 0.15 does not diverge at f_Ω = 0.197 ({_SECTION}, Fig. 18)", TILTED, STRAIGHT_SPEED)
@claim("C11i", f"as C11c, {_AT_TILTED_PEAK}", STRAIGHT, TILTED)
@claim("C11j", f"as C11d, {_AT_STRAIGHT_PEAK}", TILTED, STRAIGHT)
def is_steady(evidence: Evidence, case: CoatingCase, speed: float | CoatingCase) -> Finding:
    """Growth of the run at `speed`, or at this model's f6 of another coating."""
    f_omega = _distinct_peak(evidence, speed) if isinstance(speed, CoatingCase) else speed
    run, threshold = evidence.run(case, f_omega), evidence.config.analysis.divergence.growth
    holds = NO if run.divergent else PARTLY if run.saturating else YES
    source = _HISTORIES.get(speed) or f"our f6 of theta = {speed.theta:g}"
    text = f"theta = {case.theta:g} does not diverge at f_omega = {f_omega:g}: growth a revolution ({source})"
    growth, margin = _growth(run, "growth_per_revolution"), threshold - _growth(run, "growth_low")
    return Finding(text, f"not surely above {threshold:g}", growth, "1", holds, margin)


@claim("C11e", f"six worn lobes with θ = 0.15 at f_Ω = 0.190 ({_SECTION}, Fig. 19(a))", TILTED, TILTED_SPEED)
@claim("C11f", f"six worn lobes with θ = 0 at f_Ω = 0.197 ({_SECTION}, Fig. 19(b))", STRAIGHT, STRAIGHT_SPEED)
@claim("C11k", f"as C11e, {_AT_TILTED_PEAK}", TILTED)
@claim("C11l", f"as C11f, {_AT_STRAIGHT_PEAK}", STRAIGHT)
def six_lobes(evidence: Evidence, case: CoatingCase, speed: float | None = None) -> Finding:
    """Lobes worn by the run at `speed`, at this model's f6 if there is none; and the strongest harmonic."""
    f_omega = evidence.peak(case, _LOBES, "f_peak") if speed is None else speed
    run, source = evidence.run(case, f_omega), _PATTERNS[case] if speed else "our f6"
    text = f"six worn lobes with theta = {case.theta:g} at f_omega = {f_omega:g} ({source})"
    by_lobes, by_harmonic = (
        Finding(text, _LOBES, int(count), "1", *below(abs(int(count) - _LOBES), 0, 1))
        for count in (run.lobes, run.wear_harmonic)
    )
    return by_lobes.beside(by_harmonic)


def _distinct_peak(evidence: Evidence, case: CoatingCase) -> float:
    speeds = {coating: evidence.peak(coating, _LOBES, "f_peak") for coating in (STRAIGHT, TILTED)}
    if len(set(speeds.values())) == 1:
        raise NotMeasurable("f6 is the same speed of the grid with and without theta: needs a finer step")
    return speeds[case]


def _growth(run: pd.Series, column: str) -> float:
    # a run beyond the displacement limit has grown beyond measure, whatever a fit to what it left says
    return float("inf") if run.status == "unbounded" else float(run[column])
