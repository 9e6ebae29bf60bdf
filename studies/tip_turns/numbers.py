"""Numbers of studies/tip_turns/README.md."""

from docs.numbers import fixed, mm, row, rows, table
from docs.numbers.claims import changes

_COATINGS = [  # casing, E, K, θ of those of Figs. 6 to 9, 15 and 16, and of some stiff ones
    *(("2nd", E, 0.5, 0) for E in (0.11, 1.1, 2)),
    *(("2nd", 2, 0.5, 0.15), ("2nd", 11, 0.1, 0)),
    *(("2nd", 20, K, 0) for K in (0.5, 1, 10)),
    ("2nd5nd", 11, 0.5, 0),
]


def numbers(tables):
    """Return the text for each name on the page."""
    fixed_angle, turned = tables["findings"], tables["tip_turns_findings"]
    return {
        "peaks": _peaks(tables["peaks"], tables["tip_turns_peaks"]),
        "parts": fixed(len(fixed_angle)),
        "hold": fixed((fixed_angle["holds"] == "yes").sum()),
        "hold_turned": fixed((turned["holds"] == "yes").sum()),
        "changes": changes(fixed_angle, turned, ("the profile keeps its angle", "it turns")),
        "coatings": fixed(len(rows(tables["tip_turns_peaks"], order=4))),
    }


def _peaks(fixed_angle, turned):
    lines = []
    for casing, E, K, theta in _COATINGS:
        line = {"casing": casing, "(E, K)": f"({E:g}, {K:g})", "θ": f"{theta:g}"}
        for order in (4, 6):
            coating = {"casing": casing, "E": E, "K": K, "theta": theta, "order": order}
            both = [row(peaks, **coating) for peaks in (fixed_angle, turned)]
            line[f"f{order}"] = " → ".join(fixed(peak["f_peak"], 3) for peak in both)
            line[f"Y{order}, mm"] = " → ".join(mm(peak["amplitude"], 2) for peak in both)
        lines.append(line)
    return table(lines)
