"""Fig. 1: the blade's mesh, its clamped root and its eight interface nodes.

The data are ``blade/mesh.h5``.
"""

from bladerub.plots import blade_mesh
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

outputs.save(snakemake, blade_mesh.from_file(snakemake.input.mesh))
