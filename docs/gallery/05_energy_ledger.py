"""
Energy ledger
=============

Where does the energy of a rub go, and does the simulation lose any?
"""

import matplotlib.pyplot as plt

import bladerub as br

study = br.load_study("config/quick.yaml")
blade = br.build_blade(study)
run = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.206), follow=False)
energy = run.energy

# %%
# The shaft turns at constant speed and supplies the work. This energy is dissipated in the coating and between the
# surfaces, damped in the blade, or still stored at the end.

supplied = {"casing shape": energy.work_shape, "tangential force": energy.work_rotation}
taken = {
    "wear": energy.wear,
    "sliding": energy.sliding,
    "damping": energy.damping,
    "vibration at the end": energy.kinetic + energy.elastic - energy.initial,
    "elastic in the coating": energy.stored,
}

figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
for side, parts in (("supplied", supplied), ("taken", taken)):
    left = 0.0
    for name, joule in parts.items():
        axes.barh(side, joule, left=left, label=f"{side}: {name}")
        left += joule
axes.invert_yaxis()
axes.set_xlabel("energy, J")
axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize="small")
plt.show()

# %%
# Both bars must be equally long. Their difference, relative to all work exchanged in the contact, is the residual:
# the error that the time step leaves in the balance.

print(f"supplied {sum(supplied.values()):.6f} J")
print(f"taken    {sum(taken.values()):.6f} J")
print(f"residual {energy.residual:.1e}")

# %%
# So far the contact force was normal to the casing. If it leans by ``theta`` = 0.15 rad against the rotation, most of the
# energy goes into sliding.

leaning = br.simulate(blade, study.run("2nd", E=2, K=0.5, theta=0.15, f_omega=0.206), follow=False).energy
print(f"sliding {leaning.sliding:.0f} J, wear {leaning.wear:.0f} J, damping {leaning.damping:.0f} J")
