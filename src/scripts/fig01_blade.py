"""Fig. 1: the blade's mesh, its clamped root and its eight interface nodes.

The data are ``blade/mesh.h5``.
"""

from bladerub.io import hdf5
from bladerub.plots.blade_mesh import blade_mesh
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

mesh, _ = hdf5.read(snakemake.input.mesh)
nodes = (mesh[f"{name}_nodes"] for name in ("interface", "root", "tip"))
outputs.save(snakemake, blade_mesh(mesh["points"], mesh["cells"], *nodes))
