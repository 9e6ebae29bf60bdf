"""Write the reference of the config from its schema."""

from bladerub import atomic, job
from bladerub.config import load
from bladerub.config_reference import reference

job.log_to(snakemake.log[0])

schema, config = load(snakemake.input.schema), load(snakemake.input.config)
with atomic.writing(snakemake.output[0]) as stream:
    stream.write(reference(schema, config))
