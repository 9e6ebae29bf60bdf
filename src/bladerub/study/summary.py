"""The summary of one run in a few numbers."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from bladerub.contact.result import RunResult
from bladerub.contact.spec import RunSpec
from bladerub.study.growth import judge
from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import lobes

_LOWEST_ORDER = 0.5
"""Below it a spectrum shows the slow drift of the mean, not vibration."""


def spectral_peak(order: np.ndarray, amplitude: np.ndarray) -> tuple[float, float]:
    """Return order and height (m) of the largest amplitude of a spectrum (m,) from order 0.5 up.

    The height is NaN when the spectrum is.
    """
    vibration = np.where(order >= _LOWEST_ORDER, amplitude, 0.0)
    at = np.argmax(vibration)
    return float(order[at]), float(vibration[at])


def displacement_peak(revolution_peak: np.ndarray, revolutions: int) -> float:
    """Find the largest displacement (m) over the last `revolutions`, or over as many before an early end.

    `revolution_peak` (r,) is the largest in each revolution, m; NaN after an unbounded end.
    """
    return float(revolution_peak[np.isfinite(revolution_peak)][-revolutions:].max())


def summarise(spec: RunSpec, result: RunResult, config: Mapping[str, Any]) -> dict[str, Any]:
    """Summarise one run by the settings in ``config["analysis"]``, in plain Python values.

    Returns
    -------
    dict
        ``peak_amplitude`` (m): largest absolute radial displacement of node 1 over the last
        ``analysis.spectrum_revolutions``, or over as many before an early end. ``engine_order``: of the
        largest spectral amplitude from order 0.5 up; None when the run ended within its first revolution or
        the blade never moved. ``max_wear`` (m), ``lobes``. ``growth_per_revolution`` with its confidence
        interval ``growth_low``, ``growth_high`` (0.03 is 3 %; None of a run too short), ``saturating``,
        ``divergent``: see `bladerub.study.growth`, from this run alone. ``n_steps``, ``status``.
    """
    analysis = config["analysis"]
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis["spectrum_revolutions"], analysis["max_order"]
    )
    engine_order, height = spectral_peak(order, amplitude)
    verdict = judge(result.revolution_amplitude, result.status, analysis["divergence"])
    growth = {f"growth_{name}": getattr(verdict.growth, name) for name in ("per_revolution", "low", "high")}
    return {
        "peak_amplitude": displacement_peak(result.revolution_peak, analysis["spectrum_revolutions"]),
        "engine_order": engine_order if height > 0 else None,
        "max_wear": float(result.wear.max()),
        "lobes": lobes(result.angle, result.wear, analysis["lobe_prominence"]),
        **{name: value if np.isfinite(value) else None for name, value in growth.items()},  # JSON has no NaN
        "saturating": verdict.saturating,
        "divergent": verdict.divergent,
        "n_steps": result.n_steps,
        "status": result.status,
    }
