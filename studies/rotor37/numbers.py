"""Numbers of studies/rotor37/README.md."""

import re

import pandas as pd

from docs.numbers import fixed, mm, percent, row, rows, table
from docs.numbers.refinement import greatest_changes, refinement

_AMPLITUDE = "rest_mu0.15.amplitude"


def numbers(tables):
    """Return the text for each name on the page."""
    names = ("blade", "direct", "interaction", "coatings")
    reference = {name: tables[f"benchmarks/rotor37/{name}"].set_index("number") for name in names}
    blade, direct, interaction, coatings = reference.values()
    independent, nlstep = (tables[f"benchmarks/rotor37/{name}"] for name in ("independent", "nlstep"))
    friction = direct.loc[_AMPLITUDE]
    nlstep_error = rows(nlstep, number=_AMPLITUDE)["value"] / friction["value"] - 1
    return (
        {
            **{f"numbers_{name}": fixed(len(numbers)) for name, numbers in reference.items()},
            "frequencies": _frequencies(blade),
            "lean_leading_edge": fixed(blade.loc["lean_leading_edge", "value"], 2),
            "lean_trailing_edge": fixed(blade.loc["lean_trailing_edge", "value"], 2),
            "direct": _direct(direct),
            "nlstep": _nlstep(nlstep, direct["value"]),
            "nlstep_error": percent(nlstep_error.abs().max(), 1),
            "direct_uncertainty": percent(friction["uncertainty"] / friction["value"], 1),
            "rigid_peaks": _rigid_peaks(interaction),
            "coatings": _coatings(coatings),
        }
        | _independent(independent, direct)
        | _nodes(tables["rotor37_more_nodes"])
    )


def _frequencies(blade):
    lines = {"mode": range(1, 5)}
    for heading, speed in (("at rest, Hz", "rest"), ("at the design speed, Hz", "nominal")):
        lines[heading] = [_with_error(blade, f"f{mode}_{speed}", 1, 1) for mode in range(1, 5)]
    return table(lines)


def _with_error(values, number, factor, digits):
    value, error = values.loc[number, ["value", "uncertainty"]]
    return f"{factor * value:.{digits}f} ± {factor * error:.{digits}f}"


def _direct(direct):
    lines = []
    for stiffening, case in (("without", "rest"), ("with", "stiffened")):
        for friction in ("0", "0.15"):
            name = f"{case}_mu{friction}"
            line = {"centrifugal stiffening": stiffening, "μ": friction}
            line["amplitude, mm"] = _with_error(direct, f"{name}.amplitude", 1e3, 4)
            for order in (2, 4, 6):
                line[f"order {order}"] = mm(direct.loc[f"{name}.order_{order}", "value"], 4)
            lines.append(line)
    return table(lines)


def _independent(independent, direct):
    amplitudes = rows(independent, number="rest_mu0.amplitude")
    direct_amplitude = direct.loc["rest_mu0.amplitude", "value"]
    all_modes = independent["modes"].max()

    def amplitude(treatment, modes=all_modes, steps=20):
        return row(amplitudes, treatment=treatment, modes=modes, steps=steps)["value"]

    integrators = {
        "massless boundary, 50 moving modes": amplitude("massless", 50),
        "massless boundary, 10 moving modes": amplitude("massless", 10),
        "Moreau-Jean time stepping": amplitude("moreau_jean_0"),
        "springs of 10⁹ N/m": amplitude("penalty_1e9"),
    }
    massless = rows(independent, treatment="massless", modes=50, steps=20).merge(direct, on="number")
    orders = massless[massless["number"].str.contains("order")]
    differences = [f"{100 * (value / direct_amplitude - 1):+.2f}" for value in integrators.values()]
    return {
        "independent": table({"independent integrator": list(integrators), "difference, %": differences}),
        "independent_step": percent(abs(amplitude("massless", 50, 10) / amplitude("massless", 50) - 1), 2),
        "independent_orders_nm": fixed(1e9 * (orders["value_x"] - orders["value_y"]).abs().max()),
    }


def _nlstep(nlstep, direct):
    lines = []
    numbers = nlstep.set_index("number").groupby(["modes", "steps_per_revolution"])["value"]
    for (modes, steps), values in numbers:
        for friction in ("0", "0.15"):
            case = f"rest_mu{friction}"
            amplitude = f"{case}.amplitude"
            if amplitude not in values:
                continue
            difference = 100 * (values - direct) / direct[amplitude]
            names = {"difference, %": amplitude} | {f"order {n}": f"{case}.order_{n}" for n in (2, 4, 6)}
            lines.append(
                {"μ": friction, "modes": modes, "steps a revolution": steps}
                | {"amplitude, mm": mm(values[amplitude], 4)}
                | {heading: f"{difference[name]:+.1f}" for heading, name in names.items()}
            )
    return table(pd.DataFrame(lines).sort_values(["μ", "modes", "steps a revolution"]))


def _rigid_peaks(interaction):
    lines = []
    for order in (4, 6, 8, 10, 12):
        line = {"order": order}
        for friction in ("0", "0.15"):
            peak = f"bumps_rigid_mu{friction}.order_{order}"
            line[f"μ = {friction}: 1/min"] = _with_error(interaction, f"{peak}.speed", 1, 0)
            line[f"μ = {friction}: mm"] = _with_error(interaction, f"{peak}.amplitude", 1e3, 3)
        lines.append(line)
    return table(lines)


def _coatings(coatings):
    lines = []
    for number in coatings.index[coatings.index.str.endswith(".deepest_wear")]:
        coating = number.removesuffix(".deepest_wear")
        E, theta = re.match(r"bumps_E(.+)_K.+_theta(.+)", coating).groups()
        line = {"coating": f"E = {E} GPa, θ = {theta}"}
        for order in (4, 6):
            line[f"order {order}: 1/min"] = _with_error(coatings, f"{coating}.order_{order}.speed", 1, 0)
            line[f"order {order}: mm"] = _with_error(coatings, f"{coating}.order_{order}.amplitude", 1e3, 2)
        line["deepest wear, mm"] = _with_error(coatings, f"{coating}.deepest_wear", 1e3, 2)
        line["divergent speeds, %"] = _with_error(coatings, f"{coating}.divergent_share", 100, 0)
        lines.append(line)
    return table(lines)


def _nodes(nodes):
    speeds = nodes.groupby(["E", "theta", "order"])["f_peak"]
    shift = (speeds.max() - speeds.min()).max()
    finest = rows(nodes, interface_nodes=24)
    changes, soft = greatest_changes(finest), greatest_changes(finest[finest["E"] < 1])
    return {
        "more_nodes": refinement(nodes, "interface_nodes"),
        "speeds_by_nodes": fixed(shift, 3),
        "Y_by_nodes": percent(changes["Y"]),
        "volume_by_nodes": percent(changes["volume"]),
        "Y_by_nodes_soft": percent(soft["Y"]),
    }
