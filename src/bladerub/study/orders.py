"""Engine orders at which the peaks of a coating are sought: those that its casing excites."""

from bladerub.settings.analysis import Peaks
from bladerub.settings.contact import AnyCasing, Casing
from bladerub.settings.study import Config
from bladerub.study.grid import casing_kind, coating_cases, speeds
from bladerub.study.paper import ORDERS


def peak_orders(config: Config, casing: str) -> list[int]:
    """Return the orders of the coatings of one casing: its ``peak_orders``, or ``analysis.peaks.orders``.

    If those are the paper's, and the casing does not excite them within the speeds of the study, they are its
    `excited_orders`.
    """
    entry, orders = config.casings[casing], config.analysis.peaks.orders
    if entry.peak_orders:
        return entry.peak_orders
    slowest, *_, fastest = speeds(config)
    suits = all(excites(entry, order) and order * slowest <= 1 <= order * fastest for order in orders)
    if suits or orders != list(ORDERS):
        return orders
    return excited_orders(config, casing) or orders


def peak_settings(config: Config, casing: str) -> Peaks:
    """Return ``config.analysis.peaks`` with the `peak_orders` of this casing."""
    return config.analysis.peaks.replaced("orders", peak_orders(config, casing))


def nodal_diameters(casing: AnyCasing) -> list[int]:
    """List the nodal diameters of a casing of the config: those with weight."""
    if not isinstance(casing, Casing):
        return casing_kind(casing).nodal_diameters(casing)
    return [n for n, w in zip(casing.nodal_diameters, casing.weights, strict=False) if w]


def excites(casing: AnyCasing, order: int) -> bool:
    """Whether a nodal diameter of `casing` (of the config) divides the order: its harmonics are excited."""
    return any(order % diameter == 0 for diameter in nodal_diameters(casing))


def excited_orders(config: Config, casing: str) -> list[int]:
    """Return the two lowest orders that the casing excites and whose peak the speeds of the study reach.

    The ``speed_window`` of such an order, with C1 at rest, ends below the highest speed, and its crossing
    with C1 at rest is not below the lowest. There may be fewer.
    """
    slowest, *_, fastest = speeds(config)
    lowest_order = config.analysis.peaks.speed_window[1] / fastest
    orders = range(1, int(config.analysis.max_order) + 1)
    excited = [
        k for k in orders if k >= lowest_order and k * slowest <= 1 and excites(config.casings[casing], k)
    ]
    return excited[:2]  # as many as the paper has


def used_casings(config: Config) -> list[str]:
    """List the casings that have a coating."""
    return list(dict.fromkeys(case.casing for case in coating_cases(config)))
