"""Fig. 1: the blade's mesh (``blade/mesh.h5``), its clamped root and its eight interface nodes."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.blade_mesh import blade_mesh

outputs.save(snakemake, blade_mesh(snakemake.input.mesh))
