"""Fig. 3: the tip profile (m) under a node that has passed over abradable elements, stress normalised."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from dataclasses import replace

import pandas as pd

from bladerub.blade.validation import read_reduced_blade
from bladerub.contact.illustration import pressed_elements
from bladerub.contact.spec import PLASTIC, Coating, TipProfile
from bladerub.plots.illustration import tip_profile

DEPTH = 0.15e-3  # of the node below the original surface, m: usual in the study
REACH = 6  # elements shown on each side of the node

scene = pressed_elements(
    replace(Coating(**snakemake.params.coating), element_law=PLASTIC),
    TipProfile(**snakemake.params.tip),
    read_reduced_blade(snakemake.input.blade).tip_radius,
    DEPTH,
    REACH,
)
columns = ("element", "shortening", "wear", "stress")
table = pd.DataFrame({name: getattr(scene, name) for name in columns})
table.insert(1, "position", scene.element * scene.width)
outputs.save(snakemake, tip_profile(scene), data=table)
