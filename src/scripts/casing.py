"""Fig. 5, initial inner shape of a casing, along each nodal diameter alone and combined (inward, m)."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from dataclasses import replace

import numpy as np
import pandas as pd

from bladerub.blade.validation import read_reduced_blade
from bladerub.contact.casing import shape
from bladerub.contact.spec import Casing
from bladerub.plots.polar import casing_polar

MOST_MAGNIFIED, LARGEST = 150, 0.4  # times, and over the radius what is drawn of a larger distortion

combined = Casing(**snakemake.params.casing)
diameters = combined.nodal_diameters
casings = {f"{n}": replace(combined, nodal_diameters=(n,), weights=(1.0,)) for n in diameters}
casings[" + ".join(map(str, diameters)) or "measured"] = combined
angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
inward = {name: casing.amplitude * shape(casing, angle) for name, casing in casings.items()}

radius = read_reduced_blade(snakemake.input.blade).tip_radius
kind = " bumps" if combined.bump_width else " nodal diameters" if diameters else ""
curves = {f"{name}{kind}": u for name, u in inward.items()}
magnification = min(MOST_MAGNIFIED, float(f"{LARGEST * radius / combined.amplitude:.1g}"))
table = pd.concat(
    pd.DataFrame({"nodal_diameters": name, "angle": angle, "inward": u}) for name, u in inward.items()
)
outputs.save(snakemake, casing_polar(angle, curves, radius, magnification), data=table)
