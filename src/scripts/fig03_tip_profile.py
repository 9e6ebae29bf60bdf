"""Fig. 3: the tip profile under an interface node that has dragged through real coating elements.

The data are in m, stress normalised.
"""

import numpy as np
import pandas as pd

from bladerub.contact import law, tip
from bladerub.contact.spec import Coating, TipProfile
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.tip_profile import TipScene, tip_profile
from bladerub.workflow import job

PENETRATION = 0.15e-3  # of the node, m: a usual depth in the study
REACH = 6  # elements shown on each side of the node

job.log_to(snakemake.log[0])

layer, profile = Coating(**snakemake.params.coating), TipProfile(**snakemake.params.tip)
width = 2 * np.pi * snakemake.params.casing_radius / layer.n_elements

element = np.arange(-REACH, REACH + 1)
wear = np.zeros(element.size)
for node in np.linspace(-2 * REACH, 0, 40 * REACH + 1):  # the tip passes in small steps and stops at 0
    covered = tip.coverage(profile, element - node) > 0
    depth = PENETRATION - tip.relief(profile, element - node)
    penetration = np.where(covered, np.maximum(depth, 0), 0)
    stress, wear = law.load(layer, penetration, wear)

offset = np.linspace(-1, 1, 81) * (profile.half_width + 0.5)
scene = TipScene(
    element=element * width,
    shortening=np.maximum(penetration, wear),
    wear=wear,
    tip_position=offset * width,
    tip_depth=PENETRATION - tip.relief(profile, offset),
    width=width,
    thickness=layer.thickness,
    theta=layer.theta,
)
columns = {"element": element, "position": scene.element, "shortening": scene.shortening, "wear": wear}
table = pd.DataFrame(columns | {"stress": stress})
tables.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
figure = tip_profile(scene, f"E = {layer.E:g}, K = {layer.K:g}")
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
