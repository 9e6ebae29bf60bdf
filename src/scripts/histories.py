"""Figs. 17 and 18, and the same at our own speeds: radial displacement of node 1 (m), both angles."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.history import history

scales = outputs.scales(snakemake)
for name, runs in snakemake.params.figures.items():
    data, figure = history(runs, scales)
    outputs.save(snakemake, figure, f"{name}_", data=data)
