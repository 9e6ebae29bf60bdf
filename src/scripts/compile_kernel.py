"""Compile the time loop once, into numba's cache on disk."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import json
import time

from bladerub.contact.setup import compile_kernel
from bladerub.contact.spec import ElementLaw
from bladerub.io import atomic

start = time.monotonic()
compile_kernel(snakemake.params.tip_turns, snakemake.params.n_nodes, ElementLaw(**snakemake.params.law))
seconds = time.monotonic() - start
job.log(f"time loop compiled in {seconds:.1f} s")
with atomic.writing(snakemake.output[0]) as stream:
    json.dump({"solver": snakemake.params.solver}, stream)
