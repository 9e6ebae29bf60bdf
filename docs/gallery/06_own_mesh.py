"""
A mesh of one's own
===================

The blade can come from a mesh of another program. Here it is a twisted plate of titanium, 150 mm long.
"""

import tempfile
from pathlib import Path

import bladerub as br

# %%
# The file is of Abaqus or CalculiX (``.inp``), Gmsh (``.msh``) or VTK (``.vtu``) and has solid elements. Here the x axis
# is the engine axis and z points along the blade. The nodes of the clamped root and of the tip are sets of the file; they
# are found by the shape of the blade if no set is named.

mesh = br.default_study().folder / "config" / "blades" / "twisted_plate.inp"

# %%
# A config of a few lines names the file. What it does not say stays as in the study of the paper. This plate is shorter
# and softer than the default blade: ``scale`` gives coating and casing the same proportions to it. Its factors are
# those that ``bladerub import`` prints for the file.

config = f"""
blade:
  length: 0.15  # m
  source: {{file: {mesh}, root_set: ROOT, tip_set: TIP, tip_cone: 12.5}}
contact:
  scale: {{length: 0.75, modulus: 0.0673559, time: 2.08901}}
reduction: {{accuracy_speeds: 3}}
"""
file = Path(tempfile.mkdtemp(), "plate.yaml")
file.write_text(config)

# %%
# From here on everything is as with the default blade. A mistake in the file is an exception that names line, key and
# value.

study = br.load_study(file)
blade = br.build_blade(study)
blade.plot_mesh()

# %%
# How well does the reduced model follow the mesh? The greatest relative error of the first five frequencies:

accuracy = blade.accuracy()
print(f"{accuracy[accuracy['mode'] <= 5]['relative_error'].max():.1e}")
blade.plot_campbell()

# %%
# The plate rubs.

run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.3))
run.plot_wear()
