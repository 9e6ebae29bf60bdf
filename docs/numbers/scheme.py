"""Numbers of docs/explanation/scheme.md."""

from docs.numbers import percent
from docs.numbers.refinement import cost, greatest_changes, refinement


def numbers(tables):
    """Return the text for each name on the page."""
    bars, nodes = tables["finer_bars"], tables["more_nodes"]
    soft_bars = greatest_changes(
        bars[(bars["elements"] == 8000) & (bars["status"] == "completed") & (bars["E"] < 20)]
    )
    soft_nodes = greatest_changes(nodes[(nodes["interface_nodes"] == 24) & (nodes["E"] < 20)])
    return {
        "finer_elements": refinement(bars, "elements"),
        "Y_by_elements": percent(soft_bars["Y"], 1),
        "volume_by_elements": percent(soft_bars["volume"], 1),
        "wear_by_elements": percent(soft_bars["wear"], 1),
        "more_nodes": refinement(nodes, "interface_nodes"),
        "Y_by_nodes": percent(soft_nodes["Y"], 1),
        "volume_by_nodes": percent(soft_nodes["volume"], 1),
        "wear_by_nodes": percent(soft_nodes["wear"], 1),
        "cost_16": cost(nodes, 16),
        "cost_24": cost(nodes, 24),
    }
