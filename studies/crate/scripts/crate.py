"""Pack the study as a Workflow RO-Crate."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.crate import pack

pack(snakemake.config, snakemake.params.results, snakemake.output[0])
