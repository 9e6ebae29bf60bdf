"""Write the reference of the config from its schema."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.config.read import load
from bladerub.config.reference import reference
from bladerub.io import atomic

schema, config = load(snakemake.input.schema), load(snakemake.input.config)
with atomic.writing(snakemake.output[0]) as stream:
    stream.write(reference(schema, config))
