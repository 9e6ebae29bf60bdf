"""Fig. 4: stress–strain cycle of the coating by its return mapping, for the study's σ_Y and a visible one."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pandas as pd

from bladerub.contact import law
from bladerub.contact.spec import Coating
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.coating_cycle import Cycle, coating_cycle
from bladerub.workflow import job

STRAINS = (0.0, 0.03, 0.0, 0.05, 0.0)  # load, unload, reload further, unload
STEPS = 400  # of each branch
VISIBLE_YIELD_STRESS = 0.015  # normalised

job.log_to(snakemake.log[0])

layer = Coating(**snakemake.params.coating)
branches = [np.linspace(start, end, STEPS + 1)[1:] for start, end in pairwise(STRAINS)]
strain = np.concatenate([STRAINS[:1], *branches])

cycles, parts = [], []
for title, yield_stress in (
    ("(a) elastic limit of the study", layer.yield_stress),
    ("(b) a larger elastic limit", VISIBLE_YIELD_STRESS),
):
    bar = replace(layer, yield_stress=yield_stress)
    stress, wear = np.zeros(strain.size), np.zeros(strain.size)
    for step in range(1, strain.size):
        stress[step], wear[step] = law.load(bar, strain[step] * bar.thickness, wear[step - 1])
    cycles.append(Cycle(title, strain, stress, wear / bar.thickness, bar.E, bar.K, yield_stress))
    columns = {"strain": strain, "stress": stress, "plastic_strain": wear / bar.thickness}
    parts.append(pd.DataFrame({"yield_stress": yield_stress} | columns))

tables.write(snakemake.output.data, pd.concat(parts), provenance(snakemake.config), "%.6g")
style.save(coating_cycle(cycles), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
