"""Tabulate and draw the share of the design in which each claim holds, and what decides it."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import robustness as summary
from bladerub.extras.variations.figures import robustness as draw
from bladerub.extras.variations.job import read as read_jobs
from bladerub.extras.variations.plan import read

plan = read("robustness", snakemake.input.plan)
verdicts, cost = summary.collect(snakemake.input.verdicts), read_jobs(snakemake.input.cost)
indices = summary.sensitivities(plan, verdicts)
table = summary.summary(plan, verdicts, indices, cost)
results = {"table": table, "indices": indices, "verdicts": verdicts, "design": summary.design(plan)}
outputs.save(snakemake, draw(table, indices), **results)
