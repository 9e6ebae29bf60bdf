"""
Rigid casing against abradable coating
======================================

What does an abradable coating change? The same blade, the same casing shape and the same speeds, once with a coating
and once with direct contact.
"""

import matplotlib.pyplot as plt
import numpy as np

import bladerub as br

study = br.load_study("config/quick.yaml")
blade = br.build_blade(study)

speeds = np.arange(0.15, 0.351, 0.01)
casings = {"abradable, E = 2, K = 0.5": study.coating("2nd", E=2, K=0.5), "rigid": study.rigid("2nd")}
sweeps = {
    name: br.simulate_speeds(blade, casing, speeds, jobs=2, follow=False, progress=False)
    for name, casing in casings.items()
}

# %%
# The amplitude of the tip in the last revolution over the speed. Against the rigid casing the amplitude hardly depends on
# the speed. With the coating it is smaller at most speeds, since the coating wears until the blade passes, but much
# larger at a few: there wear and vibration feed each other.

figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
for (name, sweep), style in zip(sweeps.items(), ("o-", "s--"), strict=True):
    axes.plot(sweep.f_omega, 1e3 * sweep.to_pandas()["revolution_amplitude"], style, label=name)
axes.set(xlabel="rotational frequency over the first frequency at rest", ylabel="amplitude of the tip, mm")
axes.legend()
plt.show()

# %%
# The two motions at the speed 0.22, far from these peaks.

for casing in casings.values():
    run = br.simulate(blade, casing.at(0.22), follow=False)
    amplitude = 1e3 * run.revolution_amplitude[-1]
    print(f"{casing.name}: amplitude {amplitude:.2f} mm, wear {1e3 * run.wear.max():.2f} mm")

# %%
# Against the rigid casing:

run.plot_history()
