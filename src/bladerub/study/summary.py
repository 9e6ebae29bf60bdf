"""The summary of one run in a few numbers."""

from typing import Any

import numpy as np

from bladerub.settings.analysis import Analysis
from bladerub.study.growth import judge
from bladerub.study.store import StoredRun
from bladerub.study.wear import dominant_harmonic, lobes

LARGE_DISPLACEMENT = 0.05  # over the length of the blade, from which on small displacements are in doubt
_LOWEST_ORDER = 0.5  # below it a spectrum shows the slow drift of the mean, not vibration


def spectral_peak(order: np.ndarray, amplitude: np.ndarray) -> tuple[float, float]:
    """Return order and height (m) of the largest amplitude of a spectrum (m,) from order 0.5 up, or NaN."""
    vibration = np.where(order >= _LOWEST_ORDER, amplitude, 0.0)
    index = np.argmax(vibration)
    if np.isnan(vibration[index]):
        return np.nan, np.nan
    return float(order[index]), float(vibration[index])


def displacement_peak(revolution_peak: np.ndarray, revolutions: int) -> float:
    """Find the largest displacement (m) over the last `revolutions`, or over as many before an early end.

    `revolution_peak` (r,) is the largest in each revolution, m, NaN after an unbounded end. NaN for none.
    """
    record = revolution_peak[np.isfinite(revolution_peak)]
    return float(np.fmax.reduce(record[-revolutions:], initial=np.nan))


def summarise(run: StoredRun, analysis: Analysis, longer: StoredRun | None = None) -> dict[str, Any]:
    """Summarise one run by the settings ``config.analysis`` of the study, in plain Python values.

    ``peak_amplitude`` (m) is the largest absolute radial displacement of node 1 over the last
    ``spectrum_revolutions``, or over as many before an early end; None when the first step ended the run.
    ``engine_order`` is that of the largest spectral amplitude from order 0.5 up; None when the run ended
    within its first revolution or the blade never moved. ``max_wear`` (m), ``max_<name>`` of what else the
    law leaves in the coating (`StoredRun.layer`), ``lobes``, ``wear_harmonic`` and its share (`study.wear`).
    ``growth_per_revolution`` with its interval ``growth_low``, ``growth_high`` (0.03 is 3 %; None of a run
    too short), ``saturating``, ``divergent``, and ``growth_revolutions``: how many these were found in, those
    of the `longer` run if there is one (`bladerub.study.growth`). ``energy_residual``
    (`bladerub.contact.result.Energy`), ``n_steps``, ``status``.
    """
    data = run.data
    engine_order, height = spectral_peak(data["spectrum_order"], data["spectrum_amplitude"])
    longest = longer.data["revolution_amplitude"] if longer else None
    verdict = judge(data["revolution_amplitude"], run.attributes["status"], analysis.divergence, longest)
    harmonic, share = dominant_harmonic(data["wear"])
    peak = displacement_peak(data["revolution_peak"], analysis.spectrum_revolutions)
    growth = {f"growth_{name}": getattr(verdict.growth, name) for name in ("per_revolution", "low", "high")}
    return {
        "peak_amplitude": peak if np.isfinite(peak) else None,
        "engine_order": engine_order if height > 0 else None,
        "max_wear": float(data["wear"].max()),
        **{f"max_{name}": float(values.max()) for name, values in run.layer.items()},
        "lobes": lobes(data["angle"], data["wear"], analysis.lobe_prominence),
        "wear_harmonic": harmonic,
        "wear_harmonic_share": share,
        **{name: value if np.isfinite(value) else None for name, value in growth.items()},  # JSON has no NaN
        "saturating": verdict.saturating,
        "divergent": verdict.divergent,
        "growth_revolutions": verdict.revolutions,
        "energy_residual": float(run.attributes["energy_residual"]),
        "n_steps": run.attributes["n_steps"],
        "status": run.attributes["status"],
    }


def worn_through(wear: float, thickness: float | None) -> str:
    """Say so, to stand behind the worn depth, where that is more than the `thickness` of the layer, m."""
    if not (thickness and wear > thickness):
        return ""
    return f", through the layer of {1e3 * thickness:.4g} mm: the model has no casing below it"
