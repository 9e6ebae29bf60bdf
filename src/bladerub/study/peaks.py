"""Resonant peaks: Y_k and f_k, where the engine order k crosses the first frequency C1 (Fig. 10).

They are sought at those engine orders that the casing of a coating excites.
"""

from collections.abc import Iterable
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from bladerub.settings.analysis import Peaks
from bladerub.settings.contact import AnyCasing, Casing
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, casing_kind, coating_cases, speeds
from bladerub.study.paper import ORDERS
from bladerub.study.variants import with_variant

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ["casing", "E", "K", "theta", "order", "f_peak", "amplitude", "law"]
"""Columns of ``peaks.csv``; f_peak is normalised, amplitude in m."""


def peak_orders(config: Config, casing: str) -> list[int]:
    """Return the orders of the coatings of one casing: its ``peak_orders``, or ``analysis.peaks.orders``.

    If those are the paper's, and not all of them are excited at the study's speeds: its `excited_orders`.
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


class Response(Protocol):
    """What the search for peaks needs of one coating; a `CoatingMap` has it."""

    case: CoatingCase
    f_omega: np.ndarray
    C1: np.ndarray
    spectrum_order: np.ndarray
    spectrum_amplitude: np.ndarray


class Peak(NamedTuple):
    """Maximum of the response: speed f_k, normalised, and amplitude Y_k, m; NaN, with a reason, for none."""

    f_omega: float
    amplitude: float
    reason: str = ""


def crossing_speed(coating: Response, order: float) -> float:
    """Normalised speed where ``order * f_omega = C1(f_omega)``, linear between those of the map, or NaN."""
    f_omega = coating.f_omega
    distance = order * f_omega - coating.C1
    if not distance[0] <= 0 <= distance[-1]:
        return np.nan
    return float(np.interp(0.0, distance, f_omega))  # distance increases with speed, since C1 grows slowly


def speed_window(coating: Response, order: float, settings: Peaks) -> tuple[float, float]:
    """Lowest and highest speed between which a peak is sought, normalised; NaN as `crossing_speed`."""
    low, high = settings.speed_window
    crossing = crossing_speed(coating, order)
    return low * crossing, high * crossing


def order_amplitude(coating: Response, order: float, halfwidth: float) -> np.ndarray:
    """Largest amplitude (n,), m, within `halfwidth` of an order, or NaN; ValueError beyond the spectra."""
    on_order = np.abs(coating.spectrum_order - order) <= halfwidth + 1e-9
    if not on_order.any():
        raise ValueError(
            f"analysis.max_order: the spectra of {coating.case.name} do not reach order {order:g}"
        )
    return coating.spectrum_amplitude[:, on_order].max(axis=1)


def amplitude_in_window(
    coating: Response, order: float, settings: Peaks, window: tuple[float, float] | None = None
) -> np.ndarray:
    """Amplitude among which the peak of an engine order is sought, m (n,); NaN outside the speed `window`.

    That is the coating's `speed_window` by default. Other parameters and errors are those of `peak`.
    """
    low, high = window or speed_window(coating, order, settings)
    inside = (coating.f_omega >= low) & (coating.f_omega <= high)
    return np.where(inside, order_amplitude(coating, order, settings.order_halfwidth), np.nan)


def peak(coating: Response, order: float, settings: Peaks) -> Peak:
    """Find the maximum (f_k, Y_k) of one engine order near its crossing with C1.

    Y_k is the largest amplitude within ``order_halfwidth`` of the order, over the speeds within
    ``speed_window`` times the crossing speed; f_k is the speed of the grid where it occurs. Runs that ended
    early count with what their spectrum holds; amplitudes are NaN at speeds without a run. A blade that stays
    at rest has the amplitude 0, at no speed. `settings` is
    ``config.analysis.peaks``. The peak is NaN, with the reason, if the order does not cross C1 within
    the map, or no run with a spectrum lies in the window. Raises `ValueError` as `order_amplitude`.
    """
    candidate = maximum(coating, amplitude_in_window(coating, order, settings))
    if candidate.amplitude > 0:
        return candidate
    return Peak(np.nan, candidate.amplitude, _reason(coating, order, settings, candidate.amplitude))


def _reason(coating: Response, order: float, settings: Peaks, amplitude: float) -> str:
    """Say why an engine order has no peak; the `amplitude` is 0 or NaN."""
    if amplitude == 0:
        return f"no vibration on order {order:g} at any speed"
    low, high = speed_window(coating, order, settings)
    if np.isnan(low):
        first, last = coating.f_omega[[0, -1]]
        return f"order {order:g} does not cross C1 from f_omega = {first:g} to {last:g}: widen speeds"
    between = f"between f_omega = {low:.4f} and {high:.4f}"
    runs = np.count_nonzero((coating.f_omega >= low) & (coating.f_omega <= high))
    if runs:
        return f"none of the {runs} runs {between} has a spectrum: unbounded in their first revolution"
    return f"no run {between}: add speeds there or widen analysis.peaks.speed_window"


def maximum(coating: Response, amplitude: np.ndarray) -> Peak:
    """Return the greatest of an amplitude (n,) over the speeds of `coating`; NaN if it has none."""
    if np.isnan(amplitude).all():
        return Peak(np.nan, np.nan)
    best = int(np.nanargmax(amplitude))
    return Peak(float(coating.f_omega[best]), float(amplitude[best]))


def row(coating: Response, order: float, settings: Peaks) -> dict[str, Any]:
    """Return the row of one coating and order of the table; parameters and errors are those of `peak`."""
    f_peak, amplitude, reason = peak(coating, order, settings)
    return asdict(coating.case) | {"order": order, "f_peak": f_peak, "amplitude": amplitude, "reason": reason}


def table(config: Config, maps: Iterable[Response]) -> "pd.DataFrame":
    """Find the peaks of every coating at the orders of its casing: a row each, with `COLUMNS`.

    Where a peak is missing, f_peak and amplitude are NaN and the table has the column ``reason``; see
    `with_variant`. Raises `ValueError` as `peak`.
    """
    import pandas as pd  # spectra do without

    rows = []
    for coating in maps:
        settings = peak_settings(config, coating.case.casing)
        rows += [row(coating, order, settings) for order in settings.orders]
    return with_variant(pd.DataFrame(rows), COLUMNS, "reason")
