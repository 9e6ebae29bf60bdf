"""How coatings and speeds are named in the figures."""

from string import ascii_lowercase

from bladerub.study.grid import CoatingCase

_OWN = {"damping_ratio": "ξ = {:g}", "layer_thickness": "layer {:g} m", "interference": "interference {:g} m"}


def moduli(casing: str, E: float, K: float) -> str:
    """Casing and moduli, for instance ``casing 2nd, E = 2, K = 0.5``."""
    return f"casing {casing}, E = {E:g}, K = {K:g}"


def moduli_axes(unit: float) -> dict[str, str]:
    """Label horizontal E and vertical K, of which 1 is `unit`, Pa."""
    of = _in_units(unit)
    return {"xlabel": f"Young modulus E ({of})", "ylabel": f"plastic modulus K ({of})"}


def tangent_modulus(unit: float) -> str:
    """Label the modulus of a wearing coating, of which 1 is `unit`, Pa."""
    return f"$E_T = EK/(E+K)$ ({_in_units(unit)})"


def _in_units(unit: float) -> str:
    return f"in units of {unit / 1e6:g} MPa"


def angle(theta: float) -> str:
    """Angle of the abradable elements, for instance ``θ = 0.15 rad``."""
    return f"θ = {theta:g} rad" if theta else "θ = 0"


def coating(case: CoatingCase) -> str:
    """Full name: ``casing 2nd, E = 2, K = 0.5, θ = 0.15 rad``, or ``rigid casing 2nd, μ = 0.15``."""
    own = "".join(f", {_OWN[key].format(value)}" for key, value in case.own.items())
    if case.is_rigid:
        return f"rigid casing {case.casing}, μ = {case.friction:g}{own}"
    tangential = angle(case.theta) if case.law == "theta" else f"μ = {case.friction:g}"
    return f"{moduli(case.casing, case.E, case.K)}, {tangential}{own}"


def speed(f_omega: float) -> str:
    """Rotational frequency to three decimals."""
    return rf"$f_\Omega$ = {f_omega:.3f}"


def panel(index: int, name: str) -> str:
    """Name of a panel with its letter, for instance ``(a) eo(4)`` for index 0."""
    return f"({ascii_lowercase[index]}) {name}"
