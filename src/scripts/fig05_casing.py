"""Fig. 5: initial inner shape of the casing, along each nodal diameter alone and combined (inward, m)."""

from dataclasses import replace

import numpy as np
import pandas as pd

from bladerub.blade.model import read_reduced_blade
from bladerub.blade.tip import tip_radius
from bladerub.contact.casing import shape
from bladerub.contact.spec import Casing
from bladerub.plots.polar import casing_polar
from bladerub.workflow import job, outputs

MAGNIFICATION = 150

job.log_to(snakemake.log[0])

combined = Casing(**snakemake.params.casing)
diameters = combined.nodal_diameters
casings = {f"{n}": replace(combined, nodal_diameters=(n,), weights=(1.0,)) for n in diameters}
casings[" + ".join(map(str, diameters)) or "measured"] = combined
angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
inward = {name: casing.amplitude * shape(casing, angle) for name, casing in casings.items()}

radius = tip_radius(read_reduced_blade(snakemake.input.blade))
named = {f"{name} nodal diameters" if diameters else name: u for name, u in inward.items()}
table = pd.concat(
    pd.DataFrame({"nodal_diameters": name, "angle": angle, "inward": u}) for name, u in inward.items()
)
outputs.save(snakemake, casing_polar(angle, named, radius, MAGNIFICATION), data=table)
