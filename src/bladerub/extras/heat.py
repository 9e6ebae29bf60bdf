"""What heat changes in one run: vibration, temperature, and how soon it diverges."""

from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import simulate
from bladerub.contact.setup import compile_kernel
from bladerub.contact.spec import PLASTIC, ElementLaw, RunSpec
from bladerub.extras.law_reading import described_law
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import confirmation_spec, judge, needs_confirmation

CASING, E, K, F_OMEGA = "2nd", 2.0, 0.5, 0.19  # the run: a coating at the speed of its peak on order 6
LAYER = {
    "heat_capacity": 2e6,
    "conductivity": 5.0,
    "heated_depth": 1e-4,
    "friction_share": 0.5,
    "softening_rise": 500.0,
    "softening_exponent": 1.0,
}
"""Of the thermal law, SI units: assumed for sprayed aluminium with polyester (config/heat.yaml)."""
VARIED = ("conductivity", "friction_share", "softening_rise")
CASES = (
    *((0.0, None), (0.0, (1.0, 0.5, 500.0)), (0.15, None)),
    *((0.15, (conductivity, 0.5, 500.0)) for conductivity in (20.0, 5.0, 1.0)),
    *((0.15, (5.0, 1.0, 500.0)), (0.15, (1.0, 1.0, 500.0)), (0.15, (5.0, 1.0, 300.0))),
)
"""θ and the values of `VARIED` (W/(m K), 1, K); None for the law of the paper."""

COLUMNS = [
    *("theta", *VARIED, "largest_amplitude", "max_wear", "max_temperature_rise"),
    *("divergent", "growth_per_revolution", "revolutions"),
]


def table(config: Config, blade: ReducedBlade) -> pd.DataFrame:
    """Simulate the run of each of `CASES`, and a longer one for the verdict where it grows; `COLUMNS`."""
    compile_kernel(law=_law((1.0, 0.5, 500.0)), n_nodes=blade.n_interface)
    rows = []
    for theta, values in CASES:
        spec = run_spec(config, CoatingCase(CASING, E, K, theta), F_OMEGA)
        spec = replace(spec, coating=replace(spec.coating, element_law=_law(values)))
        rows.append((theta, *(values or [np.nan] * len(VARIED)), *_measured(config, blade, spec)))
    return pd.DataFrame(rows, columns=COLUMNS)


def _law(values: tuple[float, float, float] | None) -> ElementLaw:
    if values is None:
        return PLASTIC
    return described_law("thermal", LAYER | dict(zip(VARIED, values, strict=True)))


def _measured(config: Config, blade: ReducedBlade, spec: RunSpec) -> tuple[Any, ...]:
    settings = config.analysis.divergence
    result, longer = simulate(blade, spec), None
    if needs_confirmation(result.revolution_amplitude, result.status, settings):
        longer = simulate(blade, confirmation_spec(spec, settings)).revolution_amplitude
    verdict = judge(result.revolution_amplitude, result.status, settings, longer)
    rise = np.max(result.layer.get("temperature_rise", np.nan))
    sizes = np.nanmax(result.revolution_amplitude), result.wear.max(), rise
    return (*sizes, verdict.divergent, verdict.growth.per_revolution, verdict.revolutions)
