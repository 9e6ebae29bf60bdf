"""How coatings and speeds are named in the figures."""

from string import ascii_lowercase

from bladerub.study.grid import CoatingCase

_OWN = {"damping_ratio": "ξ = {:g}", "layer_thickness": "layer {:g} m", "interference": "interference {:g} m"}


def moduli(casing: str, E: float, K: float, unit: float | None = None) -> str:
    """Casing and moduli, as ``casing 2nd, E = 2, K = 0.5 (in units of 600 MPa)`` where 1 is `unit`, Pa."""
    return f"casing {casing}, E = {E:g}, K = {K:g}" + (f" ({in_units(unit)})" if unit else "")


def moduli_axes(unit: float) -> dict[str, str]:
    """Label horizontal E and vertical K, of which 1 is `unit`, Pa."""
    unit_text = in_units(unit)
    return {"xlabel": f"Young modulus E ({unit_text})", "ylabel": f"plastic modulus K ({unit_text})"}


def in_units(unit: float) -> str:
    """Say of moduli that 1 is `unit`, Pa."""
    return f"in units of {unit / 1e6:.4g} MPa"


def angle(theta: float) -> str:
    """Angle of the abradable elements, for instance ``θ = 0.15 rad``."""
    return f"θ = {theta:g} rad" if theta else "θ = 0"


def coating(case: CoatingCase, unit: float | None = None) -> str:
    """Full name, as ``casing 2nd, E = 2, K = 0.5, θ = 0.15 rad``, with the `unit` of the moduli, Pa."""
    variant = "".join(f", {_OWN[key].format(value)}" for key, value in case.own.items())
    if case.is_rigid:
        return f"rigid casing {case.casing}, μ = {case.friction:g}{variant}"
    tangential = angle(case.theta) if case.law == "theta" else f"μ = {case.friction:g}"
    return f"{moduli(case.casing, case.E, case.K, unit)}, {tangential}{variant}"


def speed(f_omega: float, f1_hz: float | None = None) -> str:
    """Rotational frequency to three decimals, and in rpm where the blade's first frequency is known."""
    return rf"$f_\Omega$ = {f_omega:.3f}" + (f" ({60 * f1_hz * f_omega:.0f} rpm)" if f1_hz else "")


def panel(index: int, name: str) -> str:
    """Name of a panel with its letter, for instance ``(a) eo(4)`` for index 0."""
    return f"({ascii_lowercase[index]}) {name}"
