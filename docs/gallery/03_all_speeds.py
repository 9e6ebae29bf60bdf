"""
One coating over many speeds
============================

How does the wear change as the speed passes a critical one?
"""

import numpy as np

import bladerub as br

# %%
# The oval casing (``2nd``) excites the blade at even engine orders. The first mode crosses order 6 near the speed 0.18
# and order 4 near 0.29. We simulate both neighbourhoods, two speeds at a time.

study = br.load_study("config/quick.yaml")
blade = br.build_blade(study)
coating = study.coating("2nd", E=2, K=0.5)
sweep = br.simulate_speeds(blade, coating, np.arange(0.15, 0.351, 0.01), jobs=2, progress=False)
sweep

# %%
# The wear around the casing, a row for each speed. Somewhat above each crossing the blade wears as many lobes
# as the engine order says: six at the speed 0.20, four from 0.29 on. The lower diagram counts them.

sweep.plot_wear()

# %%
# The spectra show why. The response follows the engine orders, and is strong somewhat above the crossing with the first
# mode, since the contact stiffens the blade.

sweep.plot_spectrum(max_frequency=1.6)

# %%
# A row for each speed:

sweep.to_pandas()[["max_wear", "lobes", "revolution_amplitude", "status"]]
