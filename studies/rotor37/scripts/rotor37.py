"""Reference numbers of Rotor 37 with their uncertainty, and the figures."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.plots import rotor37 as plots
from bladerub.extras.rotor37 import direct, numbers, reference
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.scales import Scales
from bladerub.plots.spectrum import spectrum_map
from bladerub.plots.wear_map import wear_map
from bladerub.settings.study import typed
from bladerub.study.grid import coating_cases, modulus_unit
from bladerub.study.maps import read_map

plain, dpi = snakemake.params.plan[reference.REFERENCE], snakemake.params.dpi
config, origin, folder = typed(plain), provenance(plain), snakemake.params.folder
cases = coating_cases(config)
parts = {
    "blade": ["blade"],
    "direct": ["direct"],
    "interaction": [case.name for case in cases if case.is_rigid],
    "coatings": [case.name for case in cases if not case.is_rigid],
}
for name, files in parts.items():
    by_set = {
        one: pd.concat(tables.read(f"{folder}/{one}/numbers/{file}.csv", numbers.COLUMNS) for file in files)
        for one in (reference.REFERENCE, *reference.VARIATIONS)
    }
    table = reference.with_uncertainty(by_set)
    outputs.save(snakemake, origin=origin, digits="%.7g", **{name: table})

reference_set = f"{folder}/{reference.REFERENCE}"
history = f"{reference_set}/history.csv"
tables.copy(history, snakemake.output.history)

blade = read_reduced_blade(f"{reference_set}/blade/reduced_model.h5")
rigid, coated = {}, {}
for case in cases:
    response = read_map(f"{reference_set}/maps/{case.name}.h5")
    if case.is_rigid:
        rigid[f"μ = {case.friction:g}"] = response
    else:
        coated.setdefault(case.theta, {})[f"E = {case.E:g} GPa"] = response
panels = {"rigid casing": rigid} | {
    f"coated casing, θ = {angle:g}": responses for angle, responses in coated.items()
}
look = config.figures
scales = Scales(modulus_unit(config), config.blade.length, blade.f1_hz, look.nominal_speed)
spectrum = partial(
    spectrum_map, amplitude_range=look.amplitude_range, f_max=look.max_frequency, scales=scales
)
straight, inclined = (response["E = 1 GPa"] for response in coated.values())
figures = {
    "response": plots.response(panels, blade.f1_hz, look.nominal_speed),
    "direct": plots.direct_contact(
        tables.read(history),
        direct.spec_of(config, blade, 0.0),
        float(np.arctan2(*blade.node_position[0, 1:])),
    ),
    "spectrum_rigid": spectrum(rigid["μ = 0.15"]),
    "spectrum_coated": spectrum(straight),
    "wear_straight": wear_map(straight, scales),
    "wear_inclined": wear_map(inclined, scales),
}
for png, pdf in zip(snakemake.output.png, snakemake.output.pdf, strict=True):
    style.save(figures[Path(png).stem], png, pdf, dpi)
