"""One coating as the page holds it: pictures coded and compressed, figures as they are."""

from __future__ import annotations

import numpy as np
import pandas as pd

from bladerub.explorer import figures, thinning
from bladerub.explorer.codes import differences, linear, log_range, logarithmic, packed
from bladerub.explorer.inert import json_text
from bladerub.study.manifest import ManifestRow
from bladerub.study.maps import CoatingMap

AMPLITUDE_FLOOR = 1e-8
"""Smallest spectral amplitude that is told apart, m; far below the colour scale of the figures."""
_SMALLEST = 1e-15
"""Amplitude of a blade at rest in the pictures of growth, m: a logarithmic axis has no zero."""


def parts(
    coating: CoatingMap,
    divergence: pd.DataFrame,
    runs: list[ManifestRow],
    spectrum_revolutions: int,
    max_frequency: float,
) -> dict[str, str]:
    """Pack one coating.

    Parameters
    ----------
    coating, divergence, runs, spectrum_revolutions
        As `bladerub.explorer.figures.of_runs`.
    max_frequency : float
        Spectra are kept up to there at least, normalised.

    Returns
    -------
    dict of str to str
        Each value as `bladerub.explorer.codes.packed`. ``wear``: bytes, n speeds × m stretches, differences
        along each row of `linear` codes. ``spectrum``: bytes, `logarithmic`, the kept orders of each speed
        one after the other. ``growth``: the same in two bytes (little-endian), the revolutions of the study's
        run, then those of the longer run, for each speed. ``figures``: JSON, `figures.of_runs` and the
        scales of the codes, in m.
    """
    bounds = thinning.stretches(coating.angle.size)
    wear, deepest = linear(thinning.stretch_means(coating.wear, bounds))
    kept = thinning.kept_orders(coating.f_omega, coating.spectrum_order, max_frequency)
    spectra = [row[:n] for row, n in zip(coating.spectrum_amplitude, kept, strict=True)]
    spectrum = np.concatenate(spectra)
    spectrum_range = AMPLITUDE_FLOOR, log_range(spectrum, AMPLITUDE_FLOOR)[1]
    growth = np.hstack([coating.revolution_amplitude, coating.confirmation_amplitude])
    growth_range = log_range(growth, _SMALLEST)
    numbers = {
        "runs": figures.of_runs(coating, divergence, runs, spectrum_revolutions),
        "deepest": deepest,
        "spectrum_range": spectrum_range,
        "growth_range": growth_range,
        "revolutions": coating.revolution_amplitude.shape[1],
        "confirmation_revolutions": coating.confirmation_amplitude.shape[1],
    }
    return {
        "wear": packed(differences(wear).tobytes()),
        "spectrum": packed(logarithmic(spectrum, *spectrum_range, np.uint8).tobytes()),
        "growth": packed(logarithmic(growth, *growth_range, np.uint16).astype("<u2").tobytes()),
        "figures": packed(json_text(numbers).encode()),
    }
