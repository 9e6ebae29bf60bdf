"""Make the small studies of some samples of the design, and put the claims of their part to each."""

import pandas as pd

from bladerub.config import read as configuration
from bladerub.extensions.robustness.design import batch
from bladerub.extensions.robustness.plan import read_plan
from bladerub.extensions.robustness.sample import COLUMNS, COST, answer
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.workflow import job

job.log_to(snakemake.log[0])

plan, part = read_plan(snakemake.params.plan), snakemake.wildcards.part
samples = batch(snakemake.config, plan, plan.parts[part], snakemake.wildcards.batch)
blades = zip(snakemake.input.models, snakemake.input.accuracies, strict=True)
verdicts, cost = [], []
for (number, config), (model, accuracy) in zip(samples.items(), blades, strict=True):
    said = answer(config, snakemake.params.claims, model, accuracy)
    verdicts.append(said.findings.assign(sample=number)[COLUMNS])
    cost.append((part, number, said.runs, said.cpu_s))
    print(f"sample {number}: {said.runs} runs in {said.cpu_s:.1f} s", flush=True)
origin = provenance({**snakemake.config, "robustness": configuration.load(snakemake.params.plan)})
tables.write(snakemake.output.verdicts, pd.concat(verdicts, ignore_index=True), origin)
tables.write(snakemake.output.cost, pd.DataFrame(cost, columns=COST), origin)
