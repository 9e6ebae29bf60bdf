"""The few figures that sum up one run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from bladerub.contact.spec import RunResult, RunSpec
from bladerub.study.divergence import is_divergent
from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import lobes

_LOWEST_ORDER = 0.5
"""Below it a spectrum shows the slow drift of the mean, not vibration."""


def spectral_peak(order: np.ndarray, amplitude: np.ndarray) -> tuple[float, float]:
    """Find the largest amplitude of a spectrum from order 0.5 up.

    Parameters
    ----------
    order, amplitude : (m,) ndarray
        From `bladerub.study.spectra.order_spectrum`, m.

    Returns
    -------
    order : float
        Engine order of the peak.
    amplitude : float
        Its height, m; NaN when the spectrum is.
    """
    vibration = np.where(order >= _LOWEST_ORDER, amplitude, 0.0)
    at = np.argmax(vibration)
    return float(order[at]), float(vibration[at])


def summarise(spec: RunSpec, result: RunResult, config: Mapping[str, Any]) -> dict[str, Any]:
    """Sum up one run.

    Parameters
    ----------
    spec, result
        The run and its outcome.
    config : mapping
        ``analysis`` decides over which revolutions.

    Returns
    -------
    dict
        ``peak_amplitude`` (m): largest absolute radial displacement of node 1 over the last
        ``analysis.spectrum_revolutions``, or over as many before an early end. ``engine_order``: of the
        largest spectral amplitude from order 0.5 up; None when the run ended within its first revolution or
        the blade never moved. ``max_wear`` (m), ``lobes``, ``divergent``, ``n_steps``, ``status``.
    """
    analysis = config["analysis"]
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis["spectrum_revolutions"], analysis["max_order"]
    )
    engine_order, height = spectral_peak(order, amplitude)
    peaks = result.revolution_peak[np.isfinite(result.revolution_peak)]
    return {
        "peak_amplitude": float(peaks[-analysis["spectrum_revolutions"] :].max()),
        "engine_order": engine_order if height > 0 else None,
        "max_wear": float(result.wear.max()),
        "lobes": lobes(result.angle, result.wear, analysis["lobe_prominence"]),
        "divergent": is_divergent(result.revolution_peak, result.status, analysis["divergence"]),
        "n_steps": result.n_steps,
        "status": result.status,
    }
