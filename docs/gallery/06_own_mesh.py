"""
A mesh of one's own
===================

The blade can come from a mesh of another program. Here it is a twisted plate of titanium, 150 mm long.
"""

import tempfile
from pathlib import Path

import bladerub as br

# %%
# The file may have any format that meshio reads. It has solid elements, a set of nodes for the clamped root and one for
# the tip. The x axis is the engine axis and z points along the blade.

mesh = br.default_study().folder / "config" / "blades" / "twisted_plate.inp"

# %%
# A config of a few lines names the file. What it does not say stays as in the study of the paper. This plate is softer
# than the default blade, so that the coating (``modulus_unit``) and the shape of the casing are scaled to it.

config = f"""
blade:
  hub_radius: 0.35  # m
  length: 0.15  # m
  tip_cone: 12.5  # degrees: how much the flow path widens
  source: {{file: {mesh}, root_set: ROOT, tip_set: TIP, tip_cone: 12.5}}
reduction: {{accuracy_speeds: 3}}
contact: {{modulus_unit: 55.0e+6, layer_thickness: 4.5e-3}}
casings:
  2nd: {{amplitude: 0.75e-3, interference: 0.375e-3}}
  2nd5nd: {{amplitude: 0.375e-3, interference: 0.375e-3}}
solver: {{max_time_step: 2.4e-6}}
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
