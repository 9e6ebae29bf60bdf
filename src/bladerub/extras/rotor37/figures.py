"""The figures of Rotor 37: response, direct contact, and maps of spectra and wear."""

from functools import partial

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.plots import rotor37 as plots
from bladerub.extras.rotor37.direct import spec_of
from bladerub.plots.maps import spectrum_map, wear_map
from bladerub.plots.scales import Scales
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases, modulus_unit
from bladerub.study.maps import read_map


def figures(config: Config, folder: str, history: pd.DataFrame) -> dict[str, Figure]:
    """Draw all by name, of the maps and the blade in `folder`, and of the `history` of direct contact."""
    blade, look = read_reduced_blade(f"{folder}/blade/reduced_model.h5"), config.figures
    rigid, coated = {}, {}
    for case in coating_cases(config):
        response = read_map(f"{folder}/maps/{case.name}.h5")
        if case.is_rigid:
            rigid[f"μ = {case.friction:g}"] = response
        else:
            coated.setdefault(case.theta, {})[f"E = {case.E:g} GPa"] = response
    panels = {"rigid casing": rigid} | {
        f"coated casing, θ = {angle:g}": responses for angle, responses in coated.items()
    }
    scales = Scales(modulus_unit(config), config.blade.length, blade.f1_hz, look.nominal_speed)
    spectrum = partial(
        spectrum_map, amplitude_range=look.amplitude_range, f_max=look.max_frequency, scales=scales
    )
    straight, inclined = (response["E = 1 GPa"] for response in coated.values())
    node_angle = float(np.arctan2(*blade.node_position[0, 1:]))
    return {
        "response": plots.response(panels, blade.f1_hz, look.nominal_speed),
        "direct": plots.direct_contact(history, spec_of(config, blade, 0.0), node_angle),
        "spectrum_rigid": spectrum(rigid["μ = 0.15"]),
        "spectrum_coated": spectrum(straight),
        "wear_straight": wear_map(straight, scales),
        "wear_inclined": wear_map(inclined, scales),
    }
