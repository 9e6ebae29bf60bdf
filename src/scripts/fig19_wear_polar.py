"""Fig. 19: worn depth around the casing (m), both angles of the elements, Figs. 17 and 18 and our speeds."""

from string import ascii_lowercase

import numpy as np
import pandas as pd

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style, titles
from bladerub.plots.wear_polar import wear_polar
from bladerub.study.maps import read_map
from bladerub.workflow import job

job.log_to(snakemake.log[0])

maps = {titles.angle(coating.case.theta): coating for coating in map(read_map, snakemake.input.maps)}
angle = next(iter(maps.values())).angle
panels, profiles = {}, []
for index, f_omega in enumerate(snakemake.params.speeds):
    letter = ascii_lowercase[index % 26]
    panel = panels[f"({letter}) {titles.speed(f_omega)}"] = {}
    for name, coating in maps.items():
        panel[name] = coating.wear[np.flatnonzero(np.isclose(coating.f_omega, f_omega))[0]]
        about = {"f_omega": f_omega, "theta": coating.case.theta}
        profiles.append(pd.DataFrame(about | {"angle": angle, "wear": panel[name]}))

tables.write(snakemake.output.data, pd.concat(profiles), provenance(snakemake.config), "%.6g")
style.save(wear_polar(angle, panels), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
