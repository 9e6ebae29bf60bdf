"""What the config of the paper's study says, fitted to coatings, casings and speeds of one's own.

Who replaces coatings, casings or speeds need not change what the paper's study says of those that were there:
its histories of runs that are no longer planned are left out, and a casing that does not excite its engine
orders gets orders of its own. It is the values that tell what is the paper's (`bladerub.study.paper`), not
the file that has them: a text means the same in ``config/config.yaml`` and in a file laid over it. Other
values are never changed, but ``contact.scale`` multiplies them: a note gives the sizes of casings.
"""

from collections.abc import Set
from typing import Any

from bladerub.study.casings import nodal_diameters
from bladerub.study.grid import SPEED_DECIMALS, UNSCALED, coating_cases, listed_case, speed_name, speeds
from bladerub.study.orders import excited_orders, excites, peak_orders, used_casings
from bladerub.study.paper import HISTORIES, ORDERS

Config = dict[str, Any]

_HISTORIES_READ = {"coatings", "speeds", "analysis"}
_READS = {*_HISTORIES_READ, "casings", "contact"}


def fit(config: Config, broken: Set[str] = frozenset()) -> tuple[Config, list[str]]:
    """Return `config`, what the paper's study says fitted to the rest, and a line for each change or doubt.

    The config agrees with the schema but for the keys at the top in `broken`, which are not read.
    Raises `ValueError` as `coating_cases`, `speeds` and `casing_spec`.
    """
    notes: list[str] = []
    if broken.isdisjoint(_HISTORIES_READ):
        config = _without_lost_histories(config, notes)
    if not broken.isdisjoint(_READS):
        return config, notes
    if config["analysis"]["peaks"]["orders"] == list(ORDERS):
        config = _with_orders_of_casings(config, notes)
    return config, notes + _scaled_casings(config) + _doubts(config)


def _scaled_casings(config: Config) -> list[str]:
    """Give the sizes that ``contact.scale`` makes of casings."""
    factor, notes = config["contact"].get("scale", UNSCALED)["length"], []
    for name in used_casings(config):
        casing = config["casings"][name]
        keys = (key for key in ("amplitude", "interference") if key in casing)
        sizes = [f"{key} {factor * casing[key]:.4g} m" for key in keys]
        if factor != 1 and sizes:
            notes.append(f"contact.scale.length = {factor:g}: casing {name} has {' and '.join(sizes)}")
    return notes


def _without_lost_histories(config: Config, notes: list[str]) -> Config:
    cases, grid, histories, omissions = set(coating_cases(config)), set(speeds(config)), [], []
    for entry in config["analysis"]["histories"]:
        case, f_omega = listed_case(entry), round(entry["f_omega"], SPEED_DECIMALS)
        if (case, f_omega) in HISTORIES and not (case in cases and f_omega in grid):
            omissions.append(f"{case.name}/{speed_name(f_omega)}")
        else:
            histories.append(entry)
    if omissions:
        ellipsis = ", ..." if len(omissions) > 1 else ""
        notes.append(
            f"analysis.histories: {len(omissions)} left out, not in this study ({omissions[0]}{ellipsis})"
        )
    return {**config, "analysis": {**config["analysis"], "histories": histories}}


def _with_orders_of_casings(config: Config, notes: list[str]) -> Config:
    orders, casings = config["analysis"]["peaks"]["orders"], dict(config["casings"])
    ends = speeds(config)[0], speeds(config)[-1]
    for name in used_casings(config):
        casing, slowest, fastest = casings[name], *ends
        suits = all(excites(casing, order) and order * slowest <= 1 <= order * fastest for order in orders)
        casing_orders = [] if suits or "peak_orders" in casing else excited_orders(config, name)
        if casing_orders:
            casings[name] = {**casing, "peak_orders": casing_orders}
            notes.append(
                f"casings.{name}.peak_orders: {casing_orders}, instead of {orders} of analysis.peaks.orders"
            )
    return {**config, "casings": casings}


def _doubts(config: Config) -> list[str]:
    """Name the casings that do not excite the orders that somebody asks for."""
    notes = []
    for name in used_casings(config):
        orders, diameters = peak_orders(config, name), nodal_diameters(config["casings"][name])
        idle = [order for order in orders if not excites(config["casings"][name], order)]
        if idle:
            why = f"nodal diameters {diameters} of casing {name} do not excite {idle}"
            proposal = f"{excited_orders(config, name)} as casings.{name}.peak_orders"
            notes.append(f"analysis.peaks.orders = {orders}: {why}; try {proposal}")
    return notes
