"""Figs. 17 and 18, and the same at our own speeds: radial displacement of node 1 (m), both angles."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.runs import histories

scales = outputs.scales(snakemake)
for name, runs in snakemake.params.figures.items():
    data, figure = histories(runs, scales)
    outputs.save(snakemake, figure, f"{name}_", data=data)
