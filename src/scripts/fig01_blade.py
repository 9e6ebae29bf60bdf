"""Fig. 1: the blade's mesh, its clamped root and its eight interface nodes.

The data are ``blade/mesh.h5``.
"""

import sys

from bladerub import datafile
from bladerub.plots import style
from bladerub.plots.blade_mesh import blade_mesh

sys.stderr = open(snakemake.log[0], "w", buffering=1)

mesh, _ = datafile.read(snakemake.input.mesh)
figure = blade_mesh(mesh["points"], mesh["hexahedra"], mesh["interface_nodes"], mesh["root_nodes"])
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
