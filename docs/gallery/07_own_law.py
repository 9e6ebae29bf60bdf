"""
A law of one's own
==================

What if the coating hardens as it is worn, as porous coatings do? The law of the coating is a module of a few functions,
which can be exchanged.
"""

from dataclasses import replace
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np

import bladerub as br
from bladerub.contact import law, reference

# %%
# The law of the paper is plasticity with linear hardening. ``law.return_mapping`` gives the force of an element and the
# wear that is added, at a depth below the worn surface. In our law the plastic modulus grows with the wear: it doubles
# for each 0.1 mm.

DOUBLING = 1e-4  # m


def return_mapping(element, depth, wear):
    """Find force (N) and added wear (m) of elements that become denser as they are worn."""
    hardening = element.hardening * 2 ** (wear / DOUBLING)
    denser = element._replace(hardening=hardening, plastic_compliance=1 / (element.elastic + hardening))
    return law.return_mapping(denser, depth, wear)


densifying = SimpleNamespace(element=law.element, return_mapping=return_mapping)

# %%
# First a single element. It is pressed down in small steps, 0.4 mm deep.

study = br.load_study("config/quick.yaml")
spec = study.run("2nd", E=2, K=0.5, f_omega=0.3).spec


def press(law, depths):
    """Force over depth of one element of 1 mm²."""
    element, wear, forces = law.element(spec.coating, 1e-6), 0.0, []
    for depth in depths:
        force, increment = law.return_mapping(element, depth - wear, wear)
        wear += increment
        forces.append(force)
    return np.array(forces)


depths = np.linspace(0, 4e-4, 200)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
axes.plot(1e3 * depths, press(law, depths), label="linear hardening")
axes.plot(1e3 * depths, press(densifying, depths), "--", label="densifying")
axes.set(xlabel="depth, mm", ylabel="force of an element of 1 mm², N")
axes.legend()
plt.show()

# %%
# Then a whole run. ``bladerub.contact.reference`` is the model on a page of plain NumPy: slow, but open to any law. A
# coarse ring of 200 elements, long time steps and two revolutions are enough to see a difference.

blade = br.build_blade(study)
short = replace(spec, coating=replace(spec.coating, n_elements=200), max_time_step=1e-5, steps_per_element=4)
period = 1 / (short.f_omega * blade.f1_hz)
n_steps = round(2 * period / reference.time_step(blade.reduced, short))

figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for name, each, style in (("linear hardening", law, "-"), ("densifying", densifying, "--")):
    _, wear = reference.simulate(blade.reduced, short, n_steps, n_modes=12, law=each)
    axes.plot(np.linspace(0, 360, 200), 1e3 * wear.mean(axis=0), style, label=name)
axes.set(xlabel="angle around the casing, degrees", ylabel="worn depth, mm")
axes.legend()
plt.show()

# %%
# To take a law into the fast time loop, change the functions of ``bladerub/contact/law.py`` themselves: the loop
# compiles them, and the energy ledger and Fig. 4 use them too. The contributing guide lists what must agree.
