"""Tables of what a finer model changes at the peaks, for pages."""

import pandas as pd

from docs.numbers import fixed, mm, percent, table


def refinement(changes: pd.DataFrame, level: str) -> str:
    """Write peaks by the levels of refinement in the column `level`; changes are from the coarsest one."""
    lines = []
    for (E, K, theta, order), peak in changes.groupby(["E", "K", "theta", "order"]):
        peak = peak.sort_values(level)
        finer = peak.iloc[1:]
        differences = ", ".join(percent(change, 1) for change in finer["wear_difference"])
        line = {"(E, K)": f"({E:g}, {K:g})", "θ": f"{theta:g}", "order": f"{order:g}"}
        line["f"] = " → ".join(fixed(f_peak, 3) for f_peak in peak["f_peak"])
        line["Y, mm"] = mm(peak["amplitude"].iloc[0], 2)
        line["change of Y, %"] = _signed(finer["amplitude_change"])
        line["of the worn volume, %"] = _signed(finer["volume_change"])
        lines.append(line | {"of the wear profile (L2), %": differences})
    return table(lines)


def greatest_changes(changes: pd.DataFrame) -> dict[str, float]:
    """Return the greatest relative change of Y, of the worn volume and of the wear profile."""
    return {
        "Y": changes["amplitude_change"].abs().max(),
        "volume": changes["volume_change"].abs().max(),
        "wear": changes["wear_difference"].max(),
    }


def cost(more_nodes: pd.DataFrame, nodes: int) -> str:
    """Write how many times the processor time of 8 interface nodes a run with `nodes` takes (medians)."""
    seconds = more_nodes.groupby("interface_nodes")["cpu_s"].median()
    return fixed(seconds[nodes] / seconds[8], 1)


def _signed(changes: pd.Series) -> str:
    return ", ".join(f"{100 * change:+.1f}" for change in changes)
