"""Make the small studies of some samples of the design, and put the claims of their part to each."""

import pandas as pd

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study.robustness.sample import COLUMNS, COST, answer

job.log_to(snakemake.log[0])

models, accuracies = snakemake.input.blades[::2], snakemake.input.blades[1::2]
samples = zip(snakemake.params.samples.items(), models, accuracies, strict=True)
verdicts, cost = [], []
for (number, config), model, accuracy in samples:
    said = answer(config, snakemake.params.claims, model, accuracy)
    verdicts.append(said.findings.assign(sample=number)[COLUMNS])
    cost.append((snakemake.wildcards.part, number, said.runs, said.cpu_s))
    print(f"sample {number}: {said.runs} runs in {said.cpu_s:.1f} s", flush=True)
origin = provenance(snakemake.config)
tablefile.write(snakemake.output.verdicts, pd.concat(verdicts, ignore_index=True), origin)
tablefile.write(snakemake.output.cost, pd.DataFrame(cost, columns=COST), origin)
