"""
Campbell diagram
================

At which speeds can the blade resonate? Where the frequency of a mode crosses a multiple of the speed: an engine order.
"""

import numpy as np

import bladerub as br

blade = br.build_blade(br.load_study("config/quick.yaml"))
blade.plot_mesh()

# %%
# Rotation stiffens the blade, so that its frequencies rise with the speed. The diagram shows them for the finite element
# model (dashed) and for the reduced model that the simulations use (solid). On the right is the first mode alone, with
# the engine orders.

# sphinx_gallery_thumbnail_number = 2
blade.plot_campbell()

# %%
# The reduced model answers at any speed of its range. The first mode meets the engine order k where
# its frequency is k times that of the rotation:

speeds = np.linspace(0.05, 0.4, 351)
first = np.array([blade.frequencies(f, n_modes=1)[0] for f in speeds]) / blade.f1_hz
for order in range(4, 9):
    crossing = speeds[np.argmin(np.abs(first - order * speeds))]
    print(f"engine order {order}: critical speed {crossing:.3f}")

# %%
# Both models are compared in a table, in Hz.

blade.accuracy().head(6)
