"""``bladerub fit-coating``: the parameters of a coating from its stress-strain curves."""

import argparse
from dataclasses import asdict
from pathlib import Path
from typing import Any

from bladerub.cli import inputs


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "fit-coating",
        fit_coating,
        blade=False,
        help="fit a coating's moduli and elastic limit to stress-strain curves",
        description="Fit Young's modulus, the plastic modulus and the elastic limit to compressive "
        "stress-strain curves by least squares, and the overstress where the curves are at several rates. "
        "State the uncertainty, which parameters the curves do not determine, and the lines for the config.",
        epilog="The table has the columns strain, stress and, for several rates, rate (1/s). A column test "
        "tells tests of one rate apart. Compression is positive. A unit stands in brackets behind a name, "
        "for instance stress (MPa).",
    )
    parser.add_argument("table", type=Path, help="stress-strain curves, CSV", metavar="CSV")
    parser.add_argument("--stress-unit", choices=("Pa", "kPa", "MPa", "GPa"), help="if the header has none")
    parser.add_argument("--strain-unit", choices=("1", "%"), help="if the header has none (default: 1)")


def fit_coating(options: argparse.Namespace) -> None:
    """Fit the law to the table that the command line names, and print the parameters."""
    from bladerub.extras.fit import fit
    from bladerub.study.grid import modulus_unit

    config = inputs.read_config(options)
    result = fit.fit_coating(options.table, strain_unit=options.strain_unit, stress_unit=options.stress_unit)
    names = [parameter.name for parameter in result.parameters]
    figures = {"points": result.n_points, "rates": list(result.rates), "residual": result.residual}
    figures["autocorrelation"] = result.autocorrelation
    figures["independent_residuals"] = not result.has_correlated_residuals
    figures["parameters"] = [asdict(parameter) for parameter in result.parameters]
    figures["covariance"] = {
        name: {other: float(value) for other, value in zip(names, row, strict=True) if value == value}
        for name, row in zip(names, result.covariance, strict=True)
    }
    unit = modulus_unit(config)  # contact.modulus_unit times contact.scale.modulus: what E is given in
    scaled = {name: result[name].value / unit for name in ("E", "K", "yield_stress")}
    figures["config"] = {"modulus_unit": config.contact.modulus_unit} | scaled
    inputs.show(options, figures, _in_words)


def _in_words(figures: dict[str, Any]) -> str:
    rates, rows = figures["rates"], figures["parameters"]
    curves = f"{figures['points']} points at {len(rates)} rate{'s' if len(rates) > 1 else ''}"
    header = inputs.row(16, "parameter", "value", "std. error", "95 % from", "to", "unit")
    lines = [f"{curves}, residual {figures['residual'] / 1e6:.3g} MPa", "", header, *map(_row, rows), ""]
    if unknown := [row["name"] for row in rows if not row["determined"]]:
        lines += [f"not determined by these curves: {', '.join(unknown)}", ""]
    if not figures["independent_residuals"]:
        correlation = f"residuals follow one another (correlation {figures['autocorrelation']:.2f})"
        meaning = "the law does not follow the curves, and the intervals are too narrow"
        lines += [f"{correlation}: {meaning}", ""]
    config = figures["config"]
    mpa = {row["name"]: f"{row['value'] / 1e6:.4g} MPa" for row in rows if row["unit"] == "Pa"}
    lines += ["for the config:", "", "contact:", f"  modulus_unit: {float(config['modulus_unit'])} # Pa"]
    lines += [f"  yield_stress: {config['yield_stress']:.6g} # {mpa['yield_stress']}", "coatings:"]
    coating = f"{{casing: 2nd, E: [{config['E']:.4g}], K: [{config['K']:.4g}], theta: [0.0]}}"
    return "\n".join([*lines, f"  - {coating} # {mpa['E']}, {mpa['K']}"])


def _row(parameter: dict[str, Any]) -> str:
    unit, factor = ("MPa", 1e-6) if parameter["unit"] == "Pa" else (parameter["unit"], 1.0)
    numbers = [parameter[key] for key in ("value", "standard_error", "low", "high")]
    cells = ["–" if number is None else f"{number * factor:.4g}" for number in numbers]
    return inputs.row(16, parameter["name"], *cells, unit)
