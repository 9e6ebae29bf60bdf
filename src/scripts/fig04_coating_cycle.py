"""Fig. 4: stress–strain cycle of the coating by its return mapping, for the study's σ_Y and a visible one."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from dataclasses import replace

import pandas as pd

from bladerub.contact.illustration import loading_cycle
from bladerub.contact.spec import PLASTIC, Coating
from bladerub.plots.illustration import coating_cycle

STRAINS = (0.0, 0.03, 0.0, 0.05, 0.0)  # load, unload, reload further, unload
STEPS = 400  # of each branch
VISIBLE_YIELD_STRESS = 0.015  # normalised

of_study = replace(Coating(**snakemake.params.coating), element_law=PLASTIC)
coatings = {
    "(a) elastic limit of the study": of_study,
    "(b) a larger elastic limit": replace(of_study, yield_stress=VISIBLE_YIELD_STRESS),
}
cycles = {title: loading_cycle(coating, STRAINS, STEPS) for title, coating in coatings.items()}
table = pd.concat(
    pd.DataFrame(
        {"yield_stress": cycle.coating.yield_stress}
        | {name: getattr(cycle, name) for name in ("strain", "stress", "plastic_strain")}
    )
    for cycle in cycles.values()
)
outputs.save(snakemake, coating_cycle(cycles), data=table)
