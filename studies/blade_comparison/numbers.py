"""Numbers of studies/blade_comparison/README.md."""

from docs.numbers import fixed, peak, rows, table


def numbers(tables):
    """Return the text for each name on the page."""
    runs = tables["twisted_plate_blade_comparison_runs"]
    divergence = tables["twisted_plate_divergence"]
    wear, reference = runs["worn_depth_share"], runs["reference_worn_depth_share"]
    ratio = wear / reference
    others = runs[runs["lobes"] != runs["reference_lobes"]]
    return {
        "blades": _blades(tables["twisted_plate_blade_comparison"]),
        "common_speeds": fixed(len(runs)),
        "same_lobes": fixed((runs["lobes"] == runs["reference_lobes"]).sum()),
        "wear_ratio": fixed(ratio.median(), 2),
        "wear_ratio_range": f"{fixed(ratio.quantile(0.1), 2)} to {fixed(ratio.quantile(0.9), 2)}",
        "wear_correlation": fixed(wear.rank().corr(reference.rank()), 2),
        "peaks": _peaks(tables["twisted_plate_peaks"], tables["peaks"]),
        "speeds": fixed(divergence["runs"].sum()),
        "divergent": fixed(rows(divergence, divergent=True)["runs"].sum()),
        "divergent_common": fixed(runs["divergent"].sum()),
        "divergent_default": fixed(runs["reference_divergent"].sum()),
        "other_lobes": table(
            others, {"f_omega": "f_Ω", "lobes": "lobes, twisted plate", "reference_lobes": "default blade"}
        ),
    }


def _blades(comparison):
    """Write the numbers of both blades: name, factor and decimals of each."""
    radial = "radial displacement of the tip under a radial force on all eight nodes, µm/N"
    what = {
        "f1": ("first frequency at rest, Hz", 1, 1),
        "f2_over_f1": ("f2 / f1", 1, 2),
        "f3_over_f1": ("f3 / f1", 1, 2),
        "stiffening": ("C1(0.4) / C1(0)", 1, 3),
        "lean_leading_edge": ("u_r / u_t of mode 1, leading edge", 1, 2),
        "lean_trailing_edge": ("the same, trailing edge", 1, 2),
        "radial_compliance": (radial, 1e6, 2),
        "centrifugal_displacement": ("largest centrifugal displacement at 0.4, mm", 1e3, 2),
        "error_eq2": ("error of eq. (2), modes 1 to 7 over [0, 0.4], %", 100, 2),
        "error_modes_1_to_6": ("error of the reduced model, modes 1 to 6, %", 100, 2),
        "error_mode_7": ("error of the reduced model, mode 7, %", 100, 2),
        "coordinates": ("reduced coordinates", 1, 0),
    }
    values = comparison.set_index(["number", "blade"])["value"]
    lines = []
    for number, (label, factor, digits) in what.items():
        this, reference = (fixed(factor * values[number, blade], digits) for blade in ("this", "reference"))
        lines.append({"": label, "twisted plate": this, "default blade": reference})
    return table(lines)


def _peaks(plate, default):
    lines = []
    for order in (4, 6):
        this, reference = (fixed(peak(peaks, 2, 0.5, order)["f_peak"], 3) for peaks in (plate, default))
        lines.append({"peak": f"f{order}", "twisted plate": this, "default blade": reference})
    return table(lines)
