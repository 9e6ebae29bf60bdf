"""What each claim measures, and the verdict on it on both sides of its borders."""

import itertools
import logging

import numpy as np
import pandas as pd
import pytest

from bladerub.study import divergence, findings, peaks
from bladerub.study.findings import claim as register
from bladerub.study.findings.claim import above, below, claim, in_order
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase
from bladerub.study.paper import CRITICAL, SOFT, STRAIGHT, TILTED, WORN

RIGID = CoatingCase.rigid("2nd", 0.0)
CLAIMS = {claim.id: claim for claim in findings.CLAIMS}
PLACES = [(TILTED, 0.19), (STRAIGHT, 0.197), (STRAIGHT, 0.19), (TILTED, 0.197)]
PLACES += [*PLACES[:2], (TILTED, 0.18), (STRAIGHT, 0.2), (STRAIGHT, 0.18), (TILTED, 0.2)]
PLACES += PLACES[6:8]
RUNS = {f"C11{part}": place for part, place in zip("abcdefghijkl", PLACES, strict=True)}
"""Coating and speed of each claim; our f6 is 0.18 and 0.2."""
DIVERGENT = {"divergent": True, "status": "unbounded", "growth_low": -0.5}


@pytest.fixture
def evidence(config):
    def make(maps=(), **tables):
        empty = {
            "peaks": pd.DataFrame(columns=peaks.COLUMNS),
            "divergence": pd.DataFrame(columns=divergence.COLUMNS),
            "rom_accuracy": pd.DataFrame(columns=["mode", "relative_error"]),
        }
        return Evidence(config, empty | tables, maps)

    return make


def measure(id_, evidence):
    return CLAIMS[id_].measure(evidence)


def is_measured(id_, evidence):
    try:
        measure(id_, evidence)
    except findings.NotMeasurable:
        return False
    return True


def check(id_, evidence, measured, holds="partly"):
    finding = measure(id_, evidence)
    assert (finding.measured, finding.holds) == (pytest.approx(measured), holds)
    return finding


def either_side(yes, partly):
    """Values just inside and just outside of the two borders of a verdict, and the verdict on each."""
    near, far = (0.999, 1.02) if yes < partly else (1.001, 0.98)
    return [(near * yes, "yes"), (far * yes, "partly"), (near * partly, "partly"), (far * partly, "no")]


def peak_rows(*rows):
    return pd.DataFrame(
        [(c.casing, c.E, c.K, c.theta, order, f, amplitude, c.law) for c, order, f, amplitude in rows],
        columns=peaks.COLUMNS,
    )


def over_moduli(value, E, K, order):
    """Peaks of the coatings (E, K), with ``value(E, K)`` as speed and amplitude both."""
    cases = [CoatingCase("2nd", e, k, 0.0) for e, k in itertools.product(E, K)]
    return peak_rows(*((case, order, value(case.E, case.K), value(case.E, case.K)) for case in cases))


@pytest.mark.parametrize(("id_", "modes", "limit"), [("C1a", range(1, 7), 0.5), ("C1b", [7], 2.0)])
def test_error_of_the_reduced_model(evidence, id_, modes, limit):
    for worst, sign, (percent, holds) in itertools.product(modes, (1, -1), either_side(limit, 4 * limit)):
        rows = [(mode, sign * percent / 100 if mode == worst else 1e-4) for mode in modes]
        rows += [(mode, 1e-4) for mode in modes]  # at another speed
        rows += [(8, 1.0), (7 if id_ == "C1a" else 6, 1.0)]  # modes that the claim is not about
        table = pd.DataFrame(rows, columns=["mode", "relative_error"])
        check(id_, evidence(rom_accuracy=table), percent, holds)
    assert not is_measured(id_, evidence(rom_accuracy=table[table["mode"] != worst]))


@pytest.mark.parametrize(("n_five", "holds"), [(150, "yes"), (149, "partly"), (50, "partly"), (49, "no")])
@pytest.mark.parametrize(("id_", "low", "high"), [("C2a", 0.0001, 0.08), ("C2b", 0.24, 0.34)])
def test_share_of_runs_with_five_lobes(evidence, make_map, id_, low, high, n_five, holds):
    inside = np.linspace(low, high, 200)  # both ends count, the next speeds do not
    f_omega = np.r_[inside, high + 2e-4, 0.239]
    lobes = np.r_[np.full(n_five, 5), np.full(200 - n_five, 6), 5, 5]
    order = np.argsort(f_omega)
    coating = make_map(WORN, {}, f_omega[order], lobes=lobes[order])
    check(id_, evidence([coating]), n_five / 2, holds)
    coating.lobes[:] = 1
    finding = measure(id_, evidence([coating]))
    assert (finding.holds, finding.holds_by_harmonic) == ("no", holds)
    assert finding.measured_by_harmonic == pytest.approx(n_five / 2)
    assert not is_measured(id_, evidence([make_map(WORN, {}, [0.09, 0.1, 0.23, 0.35, 0.38])]))


NEAR = either_side(0.025, 0.05)
PAPER = [("C2c", 0.1, 10), ("C2d", 0.38, 4), ("C3a", 0.26, 5), ("C3b", 0.38, 4)]


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("offset", "holds"), NEAR)
@pytest.mark.parametrize(("id_", "paper", "count"), PAPER)
def test_distance_from_the_papers_speed(evidence, make_map, id_, paper, count, offset, holds, sign):
    speed = paper + sign * offset
    f_omega = np.unique([0.02, 0.1, 0.26, 0.38, 0.44, speed - 1e-3, speed, speed + 1e-3])
    at = f_omega == speed
    coating = make_map(WORN, {}, f_omega, lobes=np.where(at, count, 7))
    coating.max_wear[:] = np.where(at, 1e-4, 1e-6)
    check(id_, evidence([coating]), speed, holds)
    if id_ in {"C2c", "C2d"}:
        coating.lobes[:] = 1
        finding = measure(id_, evidence([coating]))
        assert (finding.holds, finding.holds_by_harmonic) == ("no", holds)
        assert finding.measured_by_harmonic == pytest.approx(speed)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("offset", "holds"), NEAR)
@pytest.mark.parametrize(("id_", "order", "worn"), [("C3c", 5, 0.27), ("C3d", 4, 0.37)])
def test_distance_of_wear_and_vibration_maxima(evidence, make_map, id_, order, worn, offset, holds, sign):
    vibrating = worn + sign * offset
    f_omega = np.unique([0.02, 0.26, 0.38, 0.44, worn, worn + 0.01, vibrating - 1e-3, vibrating])
    coating = make_map(WORN, {}, f_omega)
    coating.max_wear[:] = np.where(f_omega == worn, 1e-4, 1e-6)
    coating.spectrum_amplitude[f_omega == vibrating, 10 * order] = 1e-3
    check(id_, evidence([coating]), sign * offset, holds)


@pytest.mark.parametrize(("offset", "near"), [(0.0249, True), (-0.0249, True), (0.0251, False)])
@pytest.mark.parametrize("id_", ["C2c", "C2d", "C3a", "C3b", "C3c", "C3d"])
def test_speeds_that_can_show_what_the_paper_sees_near_its_own(evidence, make_map, id_, offset, near):
    paper = {"C2c": 0.1, "C3a": 0.26, "C3c": 0.26}.get(id_, 0.38)
    study = evidence([make_map(WORN, {}, [paper - 0.05, paper + offset, paper + 0.1])])
    assert is_measured(id_, study) == near


@pytest.mark.parametrize(("height", "speed"), [(1.01e-5, 0.26), (0.99e-5, 0.05)])
def test_prominence_of_a_maximum_over_speed(evidence, make_map, height, speed):
    coating = make_map(WORN, {}, np.array([0.02, 0.05, 0.24, 0.26, 0.28, 0.4]))
    coating.max_wear[:] = [0, 1e-4, 0, height, 0, 0]
    assert measure("C3a", evidence([coating])).measured == speed
    for nowhere in (0.0, [1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1.09e-4]):
        coating.max_wear[:] = nowhere
        finding = measure("C3a", evidence([coating]))
        assert (finding.paper, finding.measured, finding.holds) == (0.26, "none", "no")


@pytest.mark.parametrize(("id_", "order", "paper"), [("C4a", 6, 0.21), ("C4b", 4, 0.31)])
def test_speed_of_the_soft_peaks(evidence, id_, order, paper):
    for sign, (offset, holds) in itertools.product((1, -1), NEAR):
        speed = paper + sign * offset
        table = peak_rows((SOFT, order, speed, 1e-4), (CRITICAL, order, paper, 1e-4))
        check(id_, evidence(peaks=table), speed, holds)


@pytest.mark.parametrize(("share", "holds"), either_side(0.1, 0.3))
@pytest.mark.parametrize("odd", [3, 5, 11])
def test_strength_of_odd_orders(evidence, make_map, odd, share, holds):
    coating = make_map(SOFT, {4: (0.3, 1e-3), odd: (0.2, 1e-3 * share), 1: (0.2, 1.0), 13: (0.2, 1.0)})
    coating.spectrum_amplitude[:, 10 * odd + 1] = 1.0  # next to the line
    coating.spectrum_amplitude[0] = np.nan  # a run without a spectrum
    check("C4c", evidence([coating]), share, holds)


@pytest.mark.parametrize(
    ("ids", "case", "other", "partly"),
    [(("C5a", "C5b"), CRITICAL, SOFT, 0.95), (("C10a", "C10b"), TILTED, STRAIGHT, 1.05)],
)
def test_ratio_of_the_peaks_of_two_coatings(evidence, ids, case, other, partly):
    for number, (ratio, holds) in itertools.product((0, 1), either_side(1.0, partly)):
        heights = [2 * ratio, 9.0][:: 1 - 2 * number]
        rows = [(case, order, 0.3, height) for order, height in zip((4, 6), heights, strict=True)]
        table = peak_rows(*rows, *((other, order, 0.3, 2.0) for order in (4, 6)))
        check(ids[number], evidence(peaks=table), ratio, holds)


@pytest.mark.parametrize(
    ("n_orders", "n_significant", "holds"), [(10, 9, "yes"), (10, 8, "partly"), (7, 4, "no")]
)
def test_share_of_orders_with_a_significant_amplitude(evidence, make_map, n_orders, n_significant, holds):
    orders = range(13 - n_orders, 13)  # those that cross C1 up to the highest speed
    crossing = {k: 1 / np.sqrt(k**2 - 3) for k in orders}
    f_omega = np.unique(np.round([0.02, 1.01 * max(crossing.values()), *crossing.values()], 6))
    coating = make_map(CRITICAL, {}, f_omega)
    for number, (k, f) in enumerate(crossing.items()):
        share = 1.0 if number == 0 else 0.1001 if number < n_significant else 0.0999
        coating.spectrum_amplitude[np.isclose(f_omega, f, atol=1e-5), 10 * k] = share
    check("C5c", evidence([coating]), 100 * n_significant / n_orders, holds)


def test_one_order_alone_shows_no_share(evidence, make_map):
    for speeds, judged in (([0.2, 0.25, 0.29], True), ([0.25, 0.29], False)):  # orders 4 and 5 cross C1, or 4
        coating = make_map(CRITICAL, {4: (0.25, 1e-3), 5: (0.2, 1e-3)}, speeds)
        assert is_measured("C5c", evidence([coating])) == judged


@pytest.mark.parametrize(("id_", "order"), [("C6a", 4), ("C9a", 6)])
@pytest.mark.parametrize(("other", "holds"), [(1.0, "yes"), (1.05, "partly"), (2.0, "no")])
@pytest.mark.parametrize("place", [(0.11, 5.0), (20.0, 0.05)])
def test_greatest_peak_at_the_critical_coating(evidence, id_, order, other, holds, place):
    heights = {place: other, (1.1, 0.5): 1.0, (0.1, 0.5): 9.0, (21.0, 0.5): 9.0}  # two are outside the paper
    table = over_moduli(lambda *at: heights.get(at, 0.5), [0.1, 0.11, 1.1, 20, 21], [0.05, 0.5, 5], order)
    finding = measure(id_, evidence(peaks=table))
    assert (finding.holds, finding.margin) == (holds, pytest.approx((1 - other) / max(1, other)))
    assert finding.measured.endswith(f"(1.1, 0.5) at {1 / max(1, other):.2f}")


@pytest.mark.parametrize(("n", "holds"), [(100, "yes"), (99, "partly"), (50, "partly"), (49, "no")])
def test_share_of_K_with_the_highest_peak_on_the_ridge(evidence, n, holds):
    K = [0.5, *np.linspace(1, 2, 99)]
    table = over_moduli(lambda e, k: (k <= K[n - 1]) == (e == 1.1), [0.11, 1.1], K, 4)
    check("C6b", evidence(peaks=table), n, holds)


@pytest.mark.parametrize(("share", "holds"), either_side(0.75, 0.5))
@pytest.mark.parametrize("place", [(1.1, 5.0), (0.5, 0.5), (1.5, 1.0)])
def test_lowest_of_the_other_high_peaks(evidence, place, share, holds):
    table = over_moduli(
        lambda *at: 2 * share if at == place else 2.0, [0.5, 1.1, 1.5, 2.0], [0.5, 1.0, 5.0], 4
    )
    check("C6c", evidence(peaks=table), share, holds)


@pytest.mark.parametrize(("id_", "order"), [("C7a", 4), ("C9b", 6)])
@pytest.mark.parametrize(
    ("first", "second", "holds"), [(1e-6, 0.1, "yes"), (-1e-6, 2e-6, "partly"), (-1e-6, 1e-6, "no")]
)
def test_increase_of_the_speed_of_the_peak_with_K(evidence, id_, order, first, second, holds):
    increase = {0.5: -0.1, 0.51: first, 20.0: second}  # up to E = 0.5 nothing is claimed
    table = over_moduli(
        lambda e, k: {0.05: 0.0, 0.5: -7.0, 10.0: increase[e]}[k], increase, [0.05, 0.5, 10.0], order
    )
    check(id_, evidence(peaks=table), first, holds)


@pytest.mark.parametrize(("n", "holds"), [(100, "yes"), (99, "partly"), (75, "partly"), (74, "no")])
@pytest.mark.parametrize(("id_", "order"), [("C7b", 4), ("C9c", 6)])
def test_share_of_steps_of_K_that_do_not_lower_the_speed_of_the_peak(evidence, id_, order, n, holds):
    steps = np.r_[0.0, np.full(n - 1, 1e-3), np.full(100 - n, -1e-3)]  # a step without change counts
    K = np.linspace(0.05, 10, 101)
    f_peak = dict(zip(K, np.r_[0.2, 0.2 + np.cumsum(steps)], strict=True))
    table = over_moduli(lambda e, k: f_peak[k] if e > 0.5 else -f_peak[k], [0.5, 1.1], K, order)
    check(id_, evidence(peaks=table), n, holds)


@pytest.mark.parametrize(
    ("id_", "order", "yes", "partly"),
    [("C8a", 4, 0.2, 0.5), ("C9d", 6, 0.2, 0.5), ("C8b", 4, 0.01, 0.02), ("C9e", 6, 0.01, 0.02)],
)
@pytest.mark.parametrize("worst", [0.05, 0.1])
def test_variation_with_E_at_low_K(evidence, id_, order, yes, partly, worst):
    around = {0.11: -0.5, 1.1: 0.0, 20.0: 0.5}
    for spread, holds in either_side(yes, partly):
        table = over_moduli(
            lambda e, k, s=spread: 1 + around[e] * (s if k == worst else 1.0 if k > 0.1 else 1e-4),
            *(around, [0.05, 0.1, 0.11], order),
        )
        if id_ in ("C8a", "C9d"):
            table["amplitude"] *= 3.0  # relative to the mean
        check(id_, evidence(peaks=table), spread, holds)


@pytest.mark.parametrize(("id_", "order"), [("C10c", 4), ("C10d", 6)])
@pytest.mark.parametrize(("shift", "holds"), [(-1e-6, "yes"), (0.0, "partly"), (1e-6, "no")])
def test_shift_of_the_tilted_peak(evidence, id_, order, shift, holds):
    rows = [(TILTED, k, 0.25 + (shift if k == order else 0.1), 1.0) for k in (4, 6)]
    table = peak_rows(*rows, *((STRAIGHT, k, 0.25, 1.0) for k in (4, 6)))
    assert check(id_, evidence(peaks=table), shift, holds).margin == pytest.approx(-shift)


def judged_run(evidence, id_, tilted_f6=0.18, **run):
    """Measure a claim on `run` where it looks for one, and on runs that say otherwise everywhere else."""
    own = {"growth_per_revolution": 0.0, "growth_low": 0.0, "saturating": False, "divergent": False}
    own |= {"lobes": 1, "wear_harmonic": 1, "status": "completed"} | run
    other = own | {"divergent": not own["divergent"], "growth_low": 9.0}
    other |= {"lobes": own["lobes"] + 1, "wear_harmonic": own["wear_harmonic"] + 1}
    rows = [
        {"f_omega": f_omega + 1e-7, **vars(case), **(own if (case, f_omega) == RUNS[id_] else other)}
        for case, f_omega in itertools.product((STRAIGHT, TILTED), (0.18, 0.19, 0.197, 0.2))
    ]
    at = peak_rows((TILTED, 6, tilted_f6, 1.0), (STRAIGHT, 6, 0.2, 1.0), (TILTED, 4, 0.3, 1.0))
    return measure(id_, evidence(divergence=pd.DataFrame(rows), peaks=at))


@pytest.mark.parametrize(
    ("parts", "run", "holds", "margin"),
    [
        ("abgh", {"growth_per_revolution": 0.02, "growth_low": 0.0101, "divergent": True}, "yes", 1e-4),
        ("abgh", {"growth_per_revolution": 0.0101, "growth_low": 0.01}, "partly", 0.0),
        # a beat that came again
        ("abgh", {"growth_per_revolution": 0.0101, "growth_low": 0.0101}, "no", 1e-4),
        ("abgh", {"growth_per_revolution": 0.0, "growth_low": -0.02, "saturating": True}, "partly", -0.03),
        ("abgh", DIVERGENT, "yes", np.inf),
        ("cdij", {"growth_low": 0.004}, "yes", 0.006),
        ("cdij", {"growth_low": 0.015, "saturating": True}, "partly", -0.005),
        ("cdij", DIVERGENT, "no", -np.inf),
    ],
)
def test_divergence_and_steadiness_at_a_speed(evidence, parts, run, holds, margin):
    for part in parts:
        finding = judged_run(evidence, f"C11{part}", **run)
        assert (finding.holds, finding.margin) == (holds, pytest.approx(margin, abs=1e-12))
        assert parts == "cdij" or finding.measured == run.get("growth_per_revolution", np.inf)


@pytest.mark.parametrize("id_", ["C11i", "C11j"])
def test_our_f6_tells_nothing_where_theta_does_not_move_it(evidence, id_):
    with pytest.raises(findings.NotMeasurable, match="f6 is the same speed"):
        judged_run(evidence, id_, tilted_f6=0.2)


@pytest.mark.parametrize(("lobes", "holds"), [(5, "partly"), (6, "yes"), (8, "no")])
@pytest.mark.parametrize("id_", ["C11e", "C11f", "C11k", "C11l"])
def test_six_lobes_at_a_speed(evidence, id_, lobes, holds):
    finding = judged_run(evidence, id_, lobes=lobes, wear_harmonic=2)
    assert (finding.measured, finding.holds, finding.margin) == (lobes, holds, -abs(lobes - 6))
    finding = judged_run(evidence, id_, lobes=2, wear_harmonic=lobes)
    assert (finding.holds, finding.measured_by_harmonic, finding.holds_by_harmonic) == ("no", lobes, holds)


@pytest.mark.parametrize(
    ("column", "softer", "stiffest", "holds", "margin"),
    [
        ("amplitude", 0.7, 0.801, "yes", 0.005),
        ("amplitude", 1.3, 1.201, "partly", -0.005),  # nearest, but far
        ("amplitude", 1.1, 1.101, "partly", -0.005),  # near, but a softer one is nearer
        ("amplitude", 1.25, 1.251, "no", -0.255),
        ("f_peak", 1.02, 0.9899, "partly", -0.01),
    ],
)
@pytest.mark.parametrize("order", [4, 6])
def test_distance_of_a_stiff_coating_from_the_rigid_casing(
    evidence, column, softer, stiffest, holds, margin, order
):
    values = {4.99: 1.0, 5.0: 2 * softer - 1, 11.0: softer, 20.0: stiffest}  # the softest is the furthest
    rows = [
        over_moduli(lambda e, k: 1.0 if k < 10 else values[e], values, [0.05, 10.0], order),
        over_moduli(lambda e, k: 1.0, values, [0.05, 10.0], 10 - order),
        peak_rows((RIGID, 4, 1.0, 1.0), (RIGID, 6, 1.0, 1.0)),
    ]
    table = pd.concat(rows, ignore_index=True)
    table[{"amplitude": "f_peak", "f_peak": "amplitude"}[column]] = 1.0
    if column == "f_peak":  # a softer coating that is nearer in speed would not be nearer in all
        table.loc[(table.E < 20.0) & (table.K == 10.0), "amplitude"] = 1.4
    finding = measure("C12a", evidence(peaks=table))
    assert (finding.holds, finding.margin) == (holds, pytest.approx(margin, abs=1e-9))


@pytest.mark.parametrize(("id_", "order"), [("C12c", 4), ("C12d", 6)])
@pytest.mark.parametrize(("highest", "holds"), [(1.001, "yes"), (0.999, "no")])
def test_highest_coating_over_the_rigid_casing(evidence, id_, order, highest, holds):
    # E = 0.05 and 30 are not in the paper's range
    heights = {0.05: 9.0, 0.11: 1.0, 1.1: 2.0 * highest, 20.0: 1.5, 30.0: 9.0}
    rows = [over_moduli(lambda e, k: heights[e] * k, heights, [0.5, 1.0], order)]
    rows.append(peak_rows((RIGID, order, 0.3, 2.0), (RIGID, 10 - order, 0.3, 9.0)))
    check(id_, evidence(peaks=pd.concat(rows, ignore_index=True)), highest, holds)


@pytest.mark.parametrize(("n_divergent", "holds"), [(0, "yes"), (1, "partly"), (50, "partly"), (51, "no")])
def test_share_of_divergent_runs_on_soft_coatings(evidence, n_divergent, holds):
    row = {**vars(CoatingCase("2nd", 0.1099, 0.5, 0.0)), "f_omega": 0.2, "divergent": True}
    soft = pd.DataFrame([row] * 1000).assign(divergent=np.arange(1000) < n_divergent)
    others = [row | {"E": 0.11}, row | {"casing": "2nd5nd"}, row | {"theta": 0.15}, row | {"law": "coulomb"}]
    table = pd.concat([soft, pd.DataFrame(others)], ignore_index=True)
    check("C12b", evidence(divergence=table), n_divergent / 10, holds)


def test_a_small_study_leaves_out_what_it_cannot_tell_and_logs_it(evidence, caplog):
    accuracy = pd.DataFrame({"mode": range(1, 7), "relative_error": 1e-4})
    with caplog.at_level(logging.WARNING):
        judged = findings.judge(evidence(rom_accuracy=accuracy))
    assert list(judged["id"]) == ["C1a"]
    assert list(judged.holds) == ["yes"]
    assert len(caplog.records) == len(CLAIMS) - 1
    assert "left out: C1b: " in caplog.text
    assert list(findings.judge(evidence()).columns) == list(judged.columns)


def test_moduli_are_compared_along_rows_and_columns_with_two_of_them(evidence):
    diagonal = (CRITICAL, 4, 0.3, 1.0), (CoatingCase("2nd", 2.0, 0.1, 0.0), 4, 0.3, 0.3)
    study = evidence(peaks=peak_rows(*diagonal))
    assert measure("C6a", study).holds == "yes"
    assert not any(is_measured(id_, study) for id_ in ("C6b", "C7a", "C7b", "C8a", "C8b"))
    # without the critical one, with one K, with one E within the paper's range
    for E, K in (([0.5, 2.0], [0.5, 1.0]), ([1.1, 2.0], [0.5]), ([1.1, 30.0], [0.5, 1.0])):
        without = evidence(peaks=over_moduli(lambda e, k: e, E, K, 4))
        assert not any(is_measured(id_, without) for id_ in ("C6a", "C6b"))


@pytest.mark.parametrize(
    ("dropped", "stiffest"),
    [([], 30), ([5.0], 30), ([30.0], 20), ([20.0, 30.0], None), ([5.0, 11.0, 20.0], None), ([1.0], None)],
)
def test_the_rigid_casing_is_compared_with_coatings_that_have_all_peaks(evidence, dropped, stiffest):
    """The peak on order 6 is missing; of two coatings without it, the one on order 4 would decide alone."""

    def height(E, K):
        return np.nan if K == 10.0 and E in dropped else 1.0

    moduli = [1.0, 2.0] if dropped == [1.0] else [5.0, 11.0, 20.0, 30.0], [0.05, 1.0, 10.0]
    rows = [over_moduli(lambda E, K: 1.0, *moduli, 4), over_moduli(height, *moduli, 6)]
    rows.append(peak_rows((RIGID, 4, 1.0, 1.0), (RIGID, 6, 1.0, 1.0)))
    study = evidence(peaks=pd.concat(rows, ignore_index=True))
    if stiffest is None:
        assert not is_measured("C12a", study)
    else:
        assert measure("C12a", study).claim.endswith(f"E = {stiffest}")


@pytest.fixture
def registered(monkeypatch):
    monkeypatch.setattr(register, "REGISTERED", {})
    return register.REGISTERED


def test_claims_come_by_number_and_part_whatever_the_order_of_their_registration(registered):
    for id_ in ("C10b", "C2", "C9e", "C10a", "B3a"):
        claim(id_, "statement")(lambda evidence: None)
    assert [each.id for each in in_order()] == ["B3a", "C2", "C9e", "C10a", "C10b"]


@pytest.mark.parametrize("id_", ["C1a", "", "C4ab", "c4a"])
def test_an_id_is_taken_once_and_of_one_form(registered, id_):
    claim("C1a", "statement")(lambda evidence: None)
    with pytest.raises(ValueError, match="C1a" if id_ == "C1a" else "id"):
        claim(id_, "another")


@pytest.mark.parametrize(("judge", "sign"), [(below, 1), (above, -1)])
def test_verdicts_at_their_borders(judge, sign):
    for value, expected in ((1.0, "yes"), (1.5, "partly"), (2.0, "partly"), (2.25, "no")):
        assert judge(sign * value, sign * 1.0, sign * 2.0) == (expected, 1.0 - value)
    assert judge(float("nan"), 1.0, 2.0)[0] == "no"


@pytest.mark.parametrize(("one", "other"), [(0.31, 0.3), (0.316, 0.306), (0.335, 0.325), (0.19, 0.18)])
def test_speeds_of_the_grid_that_lie_as_far_apart_as_a_border_are_within_it(one, other):
    assert below(one - other, 0.01, 0.02)[0] == "yes"
    assert above(other - one, -0.01, -0.02)[0] == "yes"
