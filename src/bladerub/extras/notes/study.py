"""What is worth knowing of a valid config: what of the paper's study it leaves out, and what is doubtful."""

from collections.abc import Iterator

import numpy as np

from bladerub.config.checks import smallest_clearance
from bladerub.contact.casing import gap
from bladerub.settings.study import Config
from bladerub.settings.units import doubted_modulus
from bladerub.study import grid
from bladerub.study.peaks import excited_orders, excites, nodal_diameters, peak_orders, used_casings


def notes(config: Config) -> list[str]:
    """List them, a line each."""
    kinds = (_histories, _orders, _scaled_casings, _idle_orders, _overlaps, _stiff_coatings)
    return [note for list_notes in kinds for note in list_notes(config)]


def _histories(config: Config) -> Iterator[str]:
    cases, planned = set(grid.coating_cases(config)), set(grid.speeds(config))
    lost = []
    for entry in config.analysis.histories:
        case, f_omega = grid.listed_case(entry), round(entry.f_omega, grid.SPEED_DECIMALS)
        if case not in cases or f_omega not in planned:
            lost.append(f"{case.name}/{grid.speed_name(f_omega)}")
    if lost:
        ellipsis = ", ..." if len(lost) > 1 else ""
        yield f"analysis.histories: {len(lost)} left out, not in this study ({lost[0]}{ellipsis})"


def _orders(config: Config) -> Iterator[str]:
    general = config.analysis.peaks.orders
    for name in used_casings(config):
        orders = peak_orders(config, name)
        if orders != general and not config.casings[name].peak_orders:
            yield f"casings.{name}.peak_orders: {orders}, instead of {general} of analysis.peaks.orders"


def _scaled_casings(config: Config) -> Iterator[str]:
    """Give the sizes that ``contact.scale`` makes of casings."""
    factor = config.contact.plugged("scale", grid.UNSCALED).length
    for name in used_casings(config):
        casing = config.casings[name]
        keys = (key for key in ("amplitude", "interference") if casing.plugged(key) is not None)
        sizes = [f"{key} {1e3 * factor * getattr(casing, key):.4g} mm" for key in keys]
        if factor != 1 and sizes:
            yield f"contact.scale.length = {factor:g}: casing {name} has {' and '.join(sizes)}"


def _idle_orders(config: Config) -> Iterator[str]:
    """Name the casings that do not excite the orders that somebody asks for."""
    for name in used_casings(config):
        orders, diameters = peak_orders(config, name), nodal_diameters(config.casings[name])
        idle = [order for order in orders if not excites(config.casings[name], order)]
        if idle:
            why = f"nodal diameters {diameters} of casing {name} do not excite {idle}"
            key = f"casings.{name}.peak_orders"
            setting = key if config.casings[name].peak_orders else "analysis.peaks.orders"
            remedy = "none that it excites crosses C1 at these speeds"
            if excited := excited_orders(config, name):
                remedy = f"try {excited} as {key}"
            yield f"{setting} = {orders}: {why}; {remedy}"


def _overlaps(config: Config) -> Iterator[str]:
    """Name the casings that the tip starts in: no work of the blade deforms them there."""
    clearance, angles = smallest_clearance(config), np.arange(360.0)
    for name in used_casings(config):
        casing = grid.casing_spec(name, config.casings[name])
        if (overlap := -float(gap(casing, clearance, casing.start_angle))) > 0:
            millimetres = 1e3 * config.contact.plugged("scale", grid.UNSCALED).length * overlap
            widest = angles[gap(casing, clearance, np.radians(angles)).argmax()]
            why = f"the tip starts {millimetres:.2g} mm inside the casing, so its energy does not balance"
            setting = f"casings.{name}.start_angle = {config.casings[name].start_angle:g}"
            yield f"{setting}: {why}; the gap is widest at {widest:g} degrees"


def _stiff_coatings(config: Config) -> Iterator[str]:
    if doubt := doubted_modulus(max(grid.young_moduli(config), default=0.0)):
        yield f"coatings: E up to {doubt}"
