"""Numbers of studies/chart/README.md."""

from functools import partial

from bladerub.extras.chart.settings import Limits
from bladerub.extras.chart.table import broken_limits
from docs.numbers import decimals, fixed, headings, mm, peak, percent, row, rows, span, table


def numbers(tables):
    """Return the text for each name on the page."""
    chart, explanation = tables["chart"], tables["chart_explanation"]
    agreement = tables["chart_agreement"]
    agreeing = rows(agreement, disagreement=0)["quantity"].value_counts()
    search = headings("quantity", "coatings") | {"exact": "found exactly", "within_1_percent": "within 1 %"}
    search["within_5_percent"] = "within 5 %"
    search["worst_missed"] = ("worst, % too low", partial(percent, digits=1))
    by_step = headings("theta", "order") | {"speed_step": "step", "E": "E of the highest", "K": "its K"}
    by_step |= {"E_T": ("its E_T", decimals(2)), "amplitude": ("height, mm", partial(mm, digits=2))}
    by_step |= {"f_peak": ("speed", decimals(3)), "neighbour_spread": ("neighbours differ by, %", percent)}
    by_step |= {"height_lost": ("height lost, %", percent), "K_shift": ("K off by the factor", decimals(1))}
    return (
        {
            "commit": chart.attrs["commit"],
            "points": fixed(len(chart)),
            "runs": fixed(chart["runs"].sum()),
            "runs_a_point": fixed(chart["runs"].mean()),
            "placement": table(tables["chart_placement_summary"], search),
            "ridge_by_step": table(tables["chart_ridge_summary"], by_step),
        }
        | _amplitudes(chart, tables["peaks"])
        | _ridge(explanation)
        | _speeds(tables["chart_stiffening"], explanation, tables["peaks"])
        | {"compared": fixed(len(rows(agreement, quantity="Y4")))}
        | {f"same_{quantity}": fixed(agreeing[quantity]) for quantity in ("Y4", "Y6")}
    )


def _amplitudes(chart, peaks):
    straight, inclined = rows(chart, theta=0), rows(chart, theta=0.15)
    stiff = straight[straight["E"] >= 0.75]
    ridge = _highest(stiff, "Y4")
    ridge6 = _highest(straight[straight["E"].between(0.17, 5)], "Y6")
    highest6 = straight.loc[straight["Y6"].idxmax()]
    kinds = []
    for kind, members in (
        ("deforms plastically (K ≤ 0.05)", chart["K"] <= 0.05),
        ("springs back (E < 0.1, K ≥ 1)", (chart["E"] < 0.1) & (chart["K"] >= 1)),
    ):
        for theta, coatings in chart[members].groupby("theta"):
            line = {"the coating": kind, "θ": f"{theta:g}"}
            line["greatest displacement, mm"] = span(coatings["peak"], mm)
            kinds.append(line | {"worn volume, cm³": span(1e6 * coatings["worn_volume"], fixed)})
    return {
        "ridge_K": span(ridge["K"], decimals(2)),
        "ridge_Y4": span(ridge["Y4"], mm),
        "Y4_soft": span(rows(stiff, K=0.02)["Y4"], mm),
        "Y4_hard": span(rows(stiff, K=20)["Y4"], mm),
        "ridge_K_Y6": span(ridge6["K"], decimals(2)),
        "Y6_highest": mm(highest6["Y6"]),
        "Y6_highest_at": f"({highest6['E']:g}, {highest6['K']:g})",
        "Y4_inclined": mm(inclined["Y4"].max()),
        "Y6_inclined": mm(inclined["Y6"].max()),
        "ridge_K_inclined": fixed(_highest(inclined[inclined["E"] >= 2], "Y4")["K"].median(), 1),
        "ridge_K_straight": fixed(_highest(straight[straight["E"] >= 2], "Y4")["K"].median(), 1),
        "Y4_paper": mm(peak(peaks, 1.1, 0.5)["amplitude"], 2),
        "Y4_ridge": mm(row(straight, casing="2nd", E=1.1, K=0.3)["Y4"], 2),
        "two_kinds": table(kinds),
        "coatings": fixed(len(straight)),
        "safe_straight": fixed(_safe(straight)),
        "safe_inclined": fixed(_safe(inclined)),
        "divergent_ridge": percent(rows(straight, K=0.3)["divergent_share"].max()),
        "divergent_ridge_inclined": percent(rows(inclined, K=0.5)["divergent_share"].max()),
        "divergent_hard": percent(straight[straight["K"] >= 5]["divergent_share"].max()),
        "divergent_soft": percent(straight[straight["K"] < 0.06]["divergent_share"].max()),
    }


def _highest(coatings, quantity):
    """Return for each E the coating with the greatest `quantity`."""
    return coatings.loc[coatings.groupby("E")[quantity].idxmax()]


def _safe(coatings):
    return (~broken_limits(coatings, Limits()).any(axis=1)).sum()


def _ridge(explanation):
    """Explain the ridge: contact stiffness, energy and lobes at the peaks."""
    correlations, lobes = [], []
    for (theta, order), peaks in explanation.groupby(["theta", "order"]):
        ranks = peaks[["amplitude", "wear_per_cycle", "E_T"]].rank().corr()["amplitude"]
        ridge, line = _highest(peaks[peaks["E"] >= 0.75], "amplitude")["E_T"], {"θ": f"{theta:g}"}
        correlations.append(
            line
            | {"order": order, "Y_k and the energy by wear": fixed(ranks["wear_per_cycle"], 2)}
            | {"Y_k and E_T": fixed(ranks["E_T"], 2), "E_T on the ridge": span(ridge, decimals(2))}
        )
        if order == 4:
            half, four = len(peaks) // 2, peaks.sort_values("amplitude")["lobes"] == 4
            line["four lobes: upper half of Y4, %"] = percent(four.tail(half).mean())
            lobes.append(line | {"lower half of Y4, %": percent(four.head(half).mean())})
    energies = {"K": "K", "wear_per_cycle": ("by wear, J", decimals(1))}
    energies |= {
        "damping_per_cycle": ("by the damping of the blade, J", decimals(1)),
        "amplitude": ("Y4, mm", mm),
    }
    return {
        "energies": table(rows(explanation, order=4, theta=0, E=2, K=[0.02, 0.1, 0.3, 1, 6, 20]), energies),
        "correlations": table(correlations),
        "lobes": table(lobes),
    }


def _speeds(stiffening, explanation, peaks):
    f4 = rows(explanation, order=4, theta=0)
    rising, falling, hard = (
        fixed(f4[(f4["E_T"] >= low) & (f4["E_T"] < high)]["f_peak"].median(), 3)
        for low, high in ((3, 4.3), (4.3, 7), (8.4, 100))
    )
    inclined = rows(stiffening, theta=0.15).set_index("order")
    other = rows(explanation, order=6, theta=0)
    other = other[other["f_peak"] < other["f_crossing"]]
    moduli = ("E_T", "K", "E")
    return {
        "stiffening": table(
            stiffening,
            headings("theta", "order", "coatings")
            | {f"rank_correlation_{E}": (f"rank correlation with {E}", decimals(2)) for E in moduli}
            | {f"scatter_{E}": (f"distance from the best rising curve of {E}", decimals(4)) for E in moduli},
        ),
        "f4_rising": rising,
        "f4_falling": falling,
        "f4_hard": hard,
        "f4_rigid": fixed(row(peaks, law="coulomb", order=4)["f_peak"], 3),
        "modulus_ratios": " and ".join(map(decimals(1), inclined["modulus_ratio"])),
        "modulus_ratios_by_share": " and ".join(map(decimals(2), inclined["modulus_ratio_by_share"])),
        "share": fixed(1 / inclined.loc[4, "modulus_ratio_by_share"], 2),
        "other_K": f"{other['K'].min():g}",
        "other_E_T": fixed(other["E_T"].min(), 1),
        "other_coatings": fixed(len(other)),
        "other_speeds": span(other["f_peak"], decimals(3)),
    }
