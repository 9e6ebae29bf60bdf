"""Each claim at the limits of its verdicts: the last value that is yes or partly, and the next."""

# ruff: noqa: F401, F811 (fixtures are imported)

import itertools

import numpy as np
import pandas as pd
import pytest
from test_findings import HARDENING, WORN, YOUNG, paper

from bladerub.study import findings
from bladerub.study.findings.evidence import Evidence
from bladerub.study.grid import CoatingCase

SOFT, CRITICAL = CoatingCase("2nd", 0.11, 0.5, 0.0), CoatingCase("2nd", 1.1, 0.5, 0.0)
SMALL = 1e-4
"""Distance from a limit, of values whose last digit is rounded."""


def around(yes, partly, distance=SMALL):
    """Cases of a value that should be small: yes up to the first limit, partly up to the second."""
    return [
        (yes - distance, "yes"),
        (yes + distance, "partly"),
        (partly - distance, "partly"),
        (partly + distance, "no"),
    ]


def falling(yes, partly, distance=SMALL):
    """Cases of a value that should be large."""
    return [(-value, holds) for value, holds in around(-yes, -partly, distance)]


def cases(of_claims):
    return [
        pytest.param(id_, value, holds, id=f"{id_}={value:g}")
        for ids, values in of_claims.items()
        for id_, (value, holds) in itertools.product(ids.split(), values)
    ]


def order_of(id_):
    return 6 if id_ in ("C4a", "C5b", "C9a", "C9b", "C9c", "C9d", "C9e", "C10b", "C10d") else 4


@pytest.fixture
def peaks(paper):
    return paper[1]["peaks"]


@pytest.fixture
def verdict(paper):
    """Judge one claim; None where the study does not show it."""

    def judged(id_):
        config, tables, maps = paper
        claims = [claim for claim in findings.CLAIMS if claim.id == id_]
        found = findings.judge(Evidence(config, tables, maps.values()), claims)
        return found["holds"].iloc[0] if len(found) else None

    return judged


def rows(table, order, E=None, K=None, theta=0.0):
    chosen = (table.order == order) & (table.theta == theta) & np.isfinite(table.E)
    chosen &= True if E is None else table.E == E
    return chosen & (True if K is None else table.K == K)


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C1a": around(0.5, 2), "C1b": around(2, 8)}))
def test_errors_of_the_reduced_model(paper, verdict, id_, value, holds):
    table = paper[1]["rom_accuracy"]
    mode = 6 if id_ == "C1a" else 7
    table.loc[(table["mode"] == mode) & (table.f_omega == 0.2), "relative_error"] = -value / 100
    assert verdict(id_) == holds


@pytest.mark.parametrize(
    ("id_", "value", "holds"), cases({"C2a C2b": [(3, "yes"), (2, "partly"), (1, "partly"), (0, "no")]})
)
def test_number_of_four_speeds_with_five_lobes(paper, verdict, make_map, id_, value, holds):
    speeds = np.array([0.02, 0.04, 0.06, 0.08] if id_ == "C2a" else [0.24, 0.27, 0.31, 0.34])
    lobes = np.where(np.arange(4) < value, 5, 6)
    beyond = np.array([0.085] if id_ == "C2a" else [0.235, 0.345])  # these do not count
    f_omega = np.concatenate([speeds, beyond])
    order = np.argsort(f_omega)
    lobes = np.concatenate([lobes, np.full(beyond.size, 5)])
    paper[2][WORN.name] = make_map(WORN, {5: (0.26, 1e-3)}, f_omega[order], lobes=lobes[order])
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C2c C2d C3a C3b C3c C3d": around(0.025, 0.05)}))
@pytest.mark.parametrize("side", [-1, 1])
def test_distance_from_the_speed_of_the_paper(paper, verdict, make_map, id_, value, holds, side):
    speed = {"C2c": 0.1, "C2d": 0.38, "C3a": 0.26, "C3b": 0.38, "C3c": 0.26, "C3d": 0.38}[id_]
    found = speed + side * value
    f_omega = np.sort([found - 0.15, found - 0.01, speed, found, found + 0.01])
    f_omega = f_omega[f_omega > 0]
    lobes = np.where(f_omega == found, {"C2c": 10, "C2d": 4}.get(id_, 7), 7)
    order = {"C3c": 5, "C3d": 4}.get(id_, 8)
    coating = make_map(WORN, {order: (found, 1e-3)}, f_omega, lobes=lobes)
    worn_at = speed if id_ in ("C3c", "C3d") else found
    coating.max_wear[:] = np.where(f_omega == worn_at, 1e-3, 1e-5)
    coating.spectrum_amplitude[f_omega != found] = 1e-7
    paper[2][WORN.name] = coating
    assert verdict(id_) == holds


@pytest.mark.parametrize("id_", ["C2c", "C3a"])
@pytest.mark.parametrize(("distance", "is_judged"), [(0.0249, True), (0.0251, False)])
def test_a_speed_with_no_run_near_is_not_judged(paper, verdict, make_map, id_, distance, is_judged):
    speed = {"C2c": 0.1, "C3a": 0.26}[id_]
    f_omega = np.array([speed - 0.05, speed + distance, speed + 0.1])
    paper[2][WORN.name] = make_map(WORN, {5: (f_omega[1], 1e-3)}, f_omega, lobes=10)
    assert (verdict(id_) is not None) == is_judged


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C4a C4b": around(0.025, 0.05)}))
@pytest.mark.parametrize("side", [-1, 1])
def test_distance_of_the_soft_peaks_from_the_speed_of_the_paper(peaks, verdict, id_, value, holds, side):
    speed = {"C4a": 0.21, "C4b": 0.31}[id_]
    peaks.loc[rows(peaks, order_of(id_), SOFT.E, SOFT.K), "f_peak"] = speed + side * value
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C4c": around(0.1, 0.3)}))
def test_odd_over_even_orders(paper, verdict, make_map, id_, value, holds):
    speeds = np.array([0.21, 0.24, 0.31])
    hats = {4: (0.31, 1e-4), 5: (0.24, value * 1e-4), 13: (0.24, 1e-4)}  # above order 12 nothing counts
    paper[2][SOFT.name] = make_map(SOFT, hats, speeds)
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C5a C5b": falling(1, 0.95)}))
def test_ratio_of_the_critical_to_the_soft_peak(peaks, verdict, id_, value, holds):
    soft = peaks.loc[rows(peaks, order_of(id_), SOFT.E, SOFT.K), "amplitude"].iloc[0]
    peaks.loc[rows(peaks, order_of(id_), CRITICAL.E, CRITICAL.K), "amplitude"] = value * soft
    assert verdict(id_) == holds


@pytest.mark.parametrize(
    ("number", "height", "holds"),
    [
        (9, 0.1001, "yes"),
        (9, 0.0999, "no"),
        (8, 0.0999, "partly"),
        (6, 0.0999, "partly"),
        (5, 0.0999, "no"),
    ],
)
def test_share_of_the_orders_that_show_where_they_cross(paper, verdict, make_map, number, height, holds):
    """`number` of the orders 4 to 12 have the full height, but for a height at which all are alike."""
    crossings = {k: 1 / np.sqrt(k**2 - 3) for k in range(4, 13)}
    hats = {k: (f, 1e-3 if k - 4 < number else height * 1e-3) for k, f in crossings.items()}
    if number == 9:
        hats = {k: (f, 1e-3 if k == 4 else height * 1e-3) for k, f in crossings.items()}
    speeds = np.sort([0.02, 0.4, *crossings.values()])
    paper[2][CRITICAL.name] = make_map(CRITICAL, hats, speeds)
    assert verdict("C5c") == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C6a C9a": falling(1, 0.9)}))
def test_the_critical_cell_over_the_greatest(peaks, verdict, id_, value, holds):
    order = order_of(id_)
    own = peaks.loc[rows(peaks, order, CRITICAL.E, CRITICAL.K), "amplitude"].iloc[0]
    peaks.loc[rows(peaks, order, 11.0, 0.5), "amplitude"] = own / value
    assert verdict(id_) == holds


@pytest.mark.parametrize(
    ("id_", "value", "holds"), cases({"C6b": [(6, "yes"), (5, "partly"), (3, "partly"), (2, "no")]})
)
def test_number_of_six_K_at_which_the_critical_E_is_highest(peaks, verdict, id_, value, holds):
    for K in HARDENING[value:]:
        peaks.loc[rows(peaks, 4, 2.0, K), "amplitude"] = 2e-3
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C6c": falling(0.75, 0.5)}))
@pytest.mark.parametrize("cell", [(1.1, 5.0), (0.5, 0.5), (1.5, 1.0)])
def test_the_lowest_of_the_high_cells(peaks, verdict, id_, value, holds, cell):
    greatest = peaks.loc[rows(peaks, 4), "amplitude"].max()
    peaks.loc[rows(peaks, 4, *cell), "amplitude"] = value * greatest
    assert verdict(id_) == holds


@pytest.mark.parametrize("id_", ["C7a", "C9b"])
@pytest.mark.parametrize(
    ("one", "others", "holds"),
    [(SMALL, SMALL, "yes"), (0, SMALL, "partly"), (-SMALL, SMALL, "partly"), (0, 0, "no")],
)
def test_rise_of_the_peak_speed_with_K(peaks, verdict, id_, one, others, holds):
    order = order_of(id_)
    peaks.loc[rows(peaks, order), "f_peak"] = 0.2
    for E in YOUNG:
        rise = -1 if E <= 0.5 else one if E == 5.0 else others  # up to E = 0.5 it may fall
        peaks.loc[rows(peaks, order, E, HARDENING[-1]), "f_peak"] = 0.2 + rise
    assert verdict(id_) == holds


@pytest.mark.parametrize("id_", ["C7b", "C9c"])
@pytest.mark.parametrize(("n_falling", "holds"), [(0, "yes"), (1, "partly"), (7, "partly"), (8, "no")])
def test_share_of_the_steps_of_K_at_which_the_peak_speed_falls(peaks, verdict, id_, n_falling, holds):
    """Six E above 0.5 with five steps of K each: 7 of 30 are less than a quarter, 8 are more."""
    order, steps = order_of(id_), itertools.product([E for E in YOUNG if E > 0.5], range(1, 6))
    fall = dict.fromkeys(itertools.islice(steps, n_falling), -SMALL)
    for E in YOUNG:
        f_peak = 0.2 + np.cumsum([fall.get((E, step), 0.0) for step in range(6)])
        for K, value in zip(HARDENING, f_peak, strict=True):
            peaks.loc[rows(peaks, order, E, K), "f_peak"] = value
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C8a C9d": around(0.2, 0.5)}))
@pytest.mark.parametrize("K", [0.05, 0.1])
def test_range_of_the_amplitudes_over_their_mean_at_low_K(peaks, verdict, id_, value, holds, K):
    order, n = order_of(id_), len(YOUNG)
    peaks.loc[rows(peaks, order, K=0.5), "amplitude"] = 1.0  # at higher K they may differ
    peaks.loc[rows(peaks, order, K=K), "amplitude"] = 1e-3
    # one of n is higher by x: x / (1 + x / n) = value
    peaks.loc[rows(peaks, order, 5.0, K), "amplitude"] = 1e-3 * (1 + value / (1 - value / n))
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C8b C9e": around(0.01, 0.02)}))
@pytest.mark.parametrize("K", [0.05, 0.1])
def test_range_of_the_peak_speeds_at_low_K(peaks, verdict, id_, value, holds, K):
    order = order_of(id_)
    peaks.loc[rows(peaks, order), "f_peak"] = 0.2
    peaks.loc[rows(peaks, order, 5.0, 0.5), "f_peak"] = 0.3
    peaks.loc[rows(peaks, order, 5.0, K), "f_peak"] = 0.2 + value
    assert verdict(id_) == holds


@pytest.mark.parametrize(("id_", "value", "holds"), cases({"C10a C10b": around(1, 1.05)}))
def test_ratio_of_the_tilted_to_the_straight_peak(peaks, verdict, id_, value, holds):
    order = order_of(id_)
    straight = peaks.loc[rows(peaks, order, 2.0, 0.5), "amplitude"].iloc[0]
    peaks.loc[rows(peaks, order, 2.0, 0.5, 0.15), "amplitude"] = value * straight
    assert verdict(id_) == holds


@pytest.mark.parametrize(
    ("id_", "value", "holds"), cases({"C10c C10d": [(-SMALL, "yes"), (0, "partly"), (SMALL, "no")]})
)
def test_shift_of_the_tilted_peak(peaks, verdict, id_, value, holds):
    order = order_of(id_)
    straight = peaks.loc[rows(peaks, order, 2.0, 0.5), "f_peak"].iloc[0]
    peaks.loc[rows(peaks, order, 2.0, 0.5, 0.15), "f_peak"] = straight + value
    assert verdict(id_) == holds


@pytest.mark.parametrize(
    ("growth", "low", "holds"),
    [
        (0.0101, 0.0101, "no"),  # surely growing, yet not called divergent
        (0.0101, 0.01, "partly"),
        (0.01, 0.0099, "no"),
    ],
)
def test_growth_that_the_scatter_hides(paper, verdict, growth, low, holds):
    table = paper[1]["divergence"]
    table[["divergent", "growth_per_revolution", "growth_low"]] = [False, growth, low]
    assert [verdict(id_) for id_ in ("C11a", "C11b", "C11g", "C11h")] == [holds] * 4


@pytest.mark.parametrize(
    ("id_", "value", "holds"),
    cases({"C11e C11f C11k C11l": [(4, "no"), (5, "partly"), (6, "yes"), (7, "partly"), (8, "no")]}),
)
def test_number_of_worn_lobes(paper, verdict, id_, value, holds):
    paper[1]["divergence"]["lobes"] = value
    assert verdict(id_) == holds


@pytest.mark.parametrize(
    ("difference", "holds"),
    [((0.1999, 0), "yes"), ((0.2001, 0), "partly"), ((0, 0.0099), "yes"), ((0, 0.0101), "partly")],
)
@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("order", [4, 6])
def test_difference_from_the_rigid_casing(peaks, verdict, difference, holds, side, order):
    rigid = np.isinf(peaks.E)
    for each in (4, 6):
        for column in ("amplitude", "f_peak"):
            value = peaks.loc[rigid & (peaks.order == each), column].iloc[0]
            for E in (5.0, 11.0):
                peaks.loc[rows(peaks, each, E, HARDENING[-1]), column] = 3 * value
            peaks.loc[rows(peaks, each, 20.0, HARDENING[-1]), column] = value
    stiffest = rows(peaks, order, 20.0, HARDENING[-1])
    peaks.loc[stiffest, "amplitude"] *= 1 + side * difference[0]
    peaks.loc[stiffest, "f_peak"] += side * difference[1]
    assert verdict("C12a") == holds


@pytest.mark.parametrize(
    ("n_runs", "n_divergent", "holds"),
    [(400, 0, "yes"), (400, 1, "partly"), (400, 20, "partly"), (399, 20, "no")],
)
def test_share_of_divergent_runs_on_softer_coatings(paper, verdict, n_runs, n_divergent, holds):
    table = paper[1]["divergence"]
    softer = pd.concat([table.iloc[:1]] * n_runs).assign(E=0.1099, divergent=np.arange(n_runs) < n_divergent)
    others = pd.concat([table.iloc[:1]] * 9).assign(E=0.11, divergent=True)  # of the paper's range
    paper[1]["divergence"] = pd.concat([table, softer, others], ignore_index=True)
    assert verdict("C12b") == holds


def test_without_a_run_in_the_range_of_five_lobes_it_is_not_judged(paper, verdict, make_map):
    paper[2][WORN.name] = make_map(WORN, {5: (0.26, 1e-3)}, [0.09, 0.1, 0.23, 0.35, 0.38])
    assert [verdict(id_) for id_ in ("C2a", "C2b")] == [None, None]


@pytest.mark.parametrize(("id_", "mode", "others"), [("C1a", 3, "C1b"), ("C1b", 7, "C1a")])
def test_without_a_mode_the_reduced_model_is_not_judged(paper, verdict, id_, mode, others):
    table = paper[1]["rom_accuracy"]
    paper[1]["rom_accuracy"] = table[table["mode"] != mode]
    assert (verdict(id_), verdict(others)) == (None, "yes")


def test_moduli_are_compared_along_rows_and_columns_with_two_of_them(paper, verdict, peaks):
    diagonal = rows(peaks, 4, 1.1, 0.5) | rows(peaks, 4, 2.0, 0.1)
    paper[1]["peaks"] = peaks[diagonal]
    assert verdict("C6a") == "yes"
    assert [verdict(id_) for id_ in ("C6b", "C7a", "C7b", "C8a", "C8b")] == [None] * 5


@pytest.mark.parametrize("dropped", [[20.0], [5.0, 11.0]])
def test_the_rigid_casing_is_compared_with_the_stiffest_and_a_softer_one(verdict, peaks, dropped):
    highest = peaks.E.isin(dropped) & (HARDENING[-1] == peaks.K)
    peaks.loc[highest, "amplitude"] = np.nan
    assert verdict("C12a") is None


def test_one_row_of_moduli_ranks_nothing(paper, verdict, peaks):
    paper[1]["peaks"] = peaks[peaks.K == 0.5]
    assert [verdict(id_) for id_ in ("C6a", "C6b", "C7a", "C9a")] == [None] * 4


@pytest.mark.parametrize(("speeds", "is_judged"), [([0.2, 0.25, 0.29], True), ([0.25, 0.29], False)])
def test_one_order_alone_shows_no_share(paper, verdict, make_map, speeds, is_judged):
    """C1 is crossed by order 4 at 0.277, by order 5 at 0.213."""
    paper[2][CRITICAL.name] = make_map(CRITICAL, {4: (0.25, 1e-3), 5: (0.2, 1e-3)}, speeds)
    assert (verdict("C5c") is not None) == is_judged


def test_verdicts_of_several_studies_are_laid_out_in_their_order():
    table = pd.DataFrame(
        [("C2a", "b", "yes"), ("C1a", "b", "no"), ("C2a", "a", "partly"), ("C1a", "a", "no")],
        columns=["id", "study", "holds"],
    )
    wide = findings.verdicts(table, by="study")
    assert (list(wide.index), list(wide.columns)) == (["C2a", "C1a"], ["b", "a"])
    assert wide.to_numpy().tolist() == [["yes", "partly"], ["no", "no"]]
