"""
First rub
=========

One blade touches the abradable coating of its casing at one constant speed. What happens to both?
"""

import bladerub as br

# %%
# A study has everything that a simulation needs: blade, casings, coatings, speeds and solver. ``config/quick.yaml`` is
# the study of the paper with a coarser mesh. The blade is meshed and reduced in a few seconds, and kept for the next
# time.

study = br.load_study("config/quick.yaml")
blade = br.build_blade(study)
blade

# %%
# The casing ``2nd`` is oval: it comes too close to the blade at two places of a revolution. The coating there has the
# Young modulus ``E`` and the plastic modulus ``K``. Both are normalised: 1 is the ``contact.modulus_unit`` of the
# config. The speed ``f_omega`` is the rotational frequency over the first frequency of the blade at rest. At 0.3
# four revolutions of the frequency, the engine order 4, are close to the first frequency of the rotating blade.

run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.3))
run

# %%
# The tip starts at rest. After the first contacts it vibrates with nearly the same amplitude to the end.

run.plot_history()

# %%
# Contact removes coating at the two places where the casing comes close. The vibration leaves two lobes in each.

run.plot_wear()

# %%
# The spectrum of the last revolutions says which multiple of the speed the blade responds to.

run.plot_spectrum()

# %%
# The numbers behind the pictures are NumPy arrays in SI units, and tables.

print(f"worn at most {1e3 * run.wear.max():.2f} mm, strongest at engine order {run.spectrum.idxmax():.1f}")
run.to_pandas().tail(3)
