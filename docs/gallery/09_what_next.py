"""
Twelve things to do next
========================

A first run is done. What an engineer asks next takes at most three lines each.
"""

import tempfile

import numpy as np

import bladerub as br
from bladerub.extras.export.animation import animate
from bladerub.extras.export.recording import record

# %%
# The study of the paper, with a blade so coarse that it is built in seconds. Settings are those of a config file, and
# are checked as such.

study = br.Study.from_settings({"blade": {"mesh": {"chordwise": 7, "spanwise": 6, "thickness": 1}}})
blade = br.build_blade(study)

# %%
# Change E
# --------
# A list in place of a number gives a list of runs. All numbers may have units: ``E=["300 MPa", "1.2 GPa"]``.

softer, stiffer = br.simulate(blade, study.run("2nd", E=[0.5, 2], K=0.5, f_omega=0.3))
stiffer

# %%
# Compare two runs in one picture
# -------------------------------
# Every plot draws into the axes that it is given, ``ax=``: a second run becomes a second line.

br.plot_spectra([softer, stiffer])

# %%
# Sweep
# -----

coating = study.coating("2nd", E=2, K=0.5)
sweep = br.simulate_speeds(blade, coating, np.arange(0.17, 0.231, 0.01), jobs=2)
sweep.plot_wear()

# %%
# Table
# -----

columns = ["rpm", "engine_order", "revolution_amplitude", "max_wear", "growth_per_revolution", "verdict"]
sweep.to_pandas()[columns].round(6)

# %%
# Campbell
# --------

blade.plot_campbell()

# %%
# Until divergence
# ----------------
# Faster and faster, until the vibration of a run grows and does not level off in its longer run.

runs = (br.simulate(blade, coating.at(f_omega)) for f_omega in np.arange(0.17, 0.35, 0.005))
divergent = next(run for run in runs if run.verdict().divergent)
divergent.plot_history()

# %%
# Save and read
# -------------

folder = tempfile.mkdtemp()
divergent.write(f"{folder}/run.h5")
print(br.read_run(f"{folder}/run.h5") == divergent)

# %%
# Other damping
# -------------

ax = stiffer.plot_spectrum().axes[0]
damped = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.3, damping_ratio="2 %"))
damped.plot_spectrum(ax=ax).figure

# %%
# Own mesh
# --------
# :doc:`06_own_mesh` says what the keys are.

file = f"{study.folder}/config/blades/twisted_plate.inp"
source = {"file": file, "root_set": "ROOT", "tip_set": "TIP", "tip_cone": 12.5}
br.build_blade(study.replace({"blade": {"length": 0.15, "source": source}})).plot_mesh()

# %%
# Rows
# ----
# Three blades on one coating, the second 50 µm longer than the others.

row = br.Row.even(3, length=[0.0, 5e-5, 0.0])
br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.3, revolutions=5), row=row).blades

# %%
# Stress
# ------
# The largest stresses of the blade in the last revolutions, Pa.

br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.3), stress=True).stress.last

# %%
# Animation
# ---------
# An animated GIF: the blade turns, vibrates and wears the coating. ``bladerub export --animation`` makes it from the
# file of a run.

planned, alone = coating.at(0.3, revolutions=3).of_length(blade.length), br.Row.even(1)
recording = record(blade.reduced, planned.spec, alone, range(100, 6001, 100))
animate(f"{folder}/run.gif", recording, blade.reduced, alone, stiffer.attributes)
