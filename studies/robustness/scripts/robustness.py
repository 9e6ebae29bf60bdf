"""Tabulate and draw the share of the design in which each claim holds, and what decides it."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import pandas as pd

from bladerub.extras.plots.robustness import robustness as draw
from bladerub.extras.robustness import summary
from bladerub.extras.robustness.plan import read_plan
from bladerub.extras.robustness.sample import COST
from bladerub.io import tables
from bladerub.workflow import outputs

plan = read_plan(snakemake.input.plan)
verdicts = summary.collect(snakemake.input.verdicts)
cost = pd.concat([tables.read(path, COST) for path in snakemake.input.cost], ignore_index=True)
indices = summary.sensitivities(plan, verdicts)
table = summary.summary(plan, verdicts, indices, cost)
results = {"table": table, "indices": indices, "verdicts": verdicts, "design": summary.design(plan)}
outputs.save(snakemake, draw(table, indices), **results)
