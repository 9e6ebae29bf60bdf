"""
A law of one's own
==================

What if the coating hardens as it is worn, as porous coatings do? A law of the coating is a Python file with a few
functions, which the time loop is compiled with.
"""

import matplotlib.pyplot as plt
import numpy as np

import bladerub as br
from bladerub.contact.laws import module_of

# %%
# The law of this example is in ``docs/laws/densifying.py``: the plastic modulus grows in proportion to the wear, and
# has doubled at 0.1 mm. ``Law`` reads the file and checks the value of its parameter.

densifying = br.Law("docs/laws/densifying.py", doubling=1e-4)
densifying.parameters

# %%
# First a single element. It is pressed down in small steps, 0.4 mm deep. ``return_mapping`` gives its force and the
# wear that is added, at a depth below the worn surface.

study = br.load_study("config/quick.yaml")
studies = {"linear hardening": study, "densifying": study.with_law(densifying)}
depths = np.linspace(0, 4e-4, 200)


def press(coating):
    """Force over depth of one element of 1 mm²."""
    law = module_of(coating.element_law)
    element, wear, forces = law.element(coating, 1e-6), 0.0, []
    for depth in depths:
        force, increment = law.return_mapping(element, depth - wear, wear)
        wear += increment
        forces.append(force)
    return np.array(forces)


figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for (name, each), style in zip(studies.items(), ("-", "--"), strict=True):
    coating = each.run("2nd", E=2, K=0.5, f_omega=0.3).spec.coating
    axes.plot(1e3 * depths, press(coating), style, label=name)
axes.set(xlabel="depth, mm", ylabel="force of an element of 1 mm², N")
axes.legend()
plt.show()

# %%
# Then whole runs. The loop is compiled at the first of them, for half a minute, and kept on the disk.

blade = br.build_blade(study)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for (name, each), style in zip(studies.items(), ("-", "--"), strict=True):
    run = br.simulate(blade, each.run("2nd", E=2, K=0.5, f_omega=0.3, revolutions=5))
    dataset = run.to_xarray()
    axes.plot(np.rad2deg(dataset.angle), 1e3 * dataset.wear.mean(axis=0), style, label=name)
    print(f"{name}: energy residual {run.energy.residual:.1g}")
axes.set(xlabel="angle around the casing, degrees", ylabel="worn depth, mm")
axes.legend()
plt.show()

# %%
# ``bladerub check-law docs/laws/densifying.py --parameter doubling=1e-4`` presses the law along random histories, and
# tells of energy that is lost or created. :doc:`/laws` says what a law must have.
