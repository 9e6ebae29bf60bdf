"""Fig. 5: initial inner shape of the casing, along each nodal diameter alone and combined (inward, m)."""

from dataclasses import replace

import numpy as np
import pandas as pd

from bladerub.contact.casing import shape
from bladerub.contact.spec import Casing
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.casing_polar import casing_polar
from bladerub.workflow import job

MAGNIFICATION = 150

job.log_to(snakemake.log[0])

combined = Casing(**snakemake.params.casing)
diameters = combined.nodal_diameters
casings = {f"{n}": replace(combined, nodal_diameters=(n,), weights=(1.0,)) for n in diameters}
casings[" + ".join(map(str, diameters))] = combined
angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
inward = {name: casing.amplitude * shape(casing, angle) for name, casing in casings.items()}

table = pd.concat(
    pd.DataFrame({"nodal_diameters": name, "angle": angle, "inward": u}) for name, u in inward.items()
)
tables.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
named = {f"{name} nodal diameters": u for name, u in inward.items()}
figure = casing_polar(angle, named, snakemake.params.casing_radius, MAGNIFICATION)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
