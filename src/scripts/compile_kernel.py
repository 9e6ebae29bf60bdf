"""Compile the time loop once, into numba's cache on disk."""

import json
import sys
import time

from bladerub.contact.run import kernel_warm_up

sys.stderr = open(snakemake.log[0], "w", buffering=1)

start = time.monotonic()
kernel_warm_up()
seconds = time.monotonic() - start
print(f"time loop compiled in {seconds:.1f} s", file=sys.stderr)
with open(snakemake.output[0], "w") as stream:
    json.dump({"solver": snakemake.params.solver}, stream)
