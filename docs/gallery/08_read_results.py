"""
Reading a finished study
========================

The results of a study are HDF5 files. xarray opens each of them, with units and names, and so does ``bladerub``.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import bladerub as br

# %%
# So that this page stands alone, it first makes what the workflow makes: a run and a map of one coating.

folder = Path(tempfile.mkdtemp())
study = br.load_study("config/quick.yaml")
blade = br.build_blade(study)
coating = study.coating("2nd", E=2, K=0.5)
br.simulate(blade, coating.at(0.3), follow=False).write(folder / "0.3000.h5", study.config)
sweep = br.simulate_speeds(blade, coating, np.arange(0.26, 0.341, 0.01), jobs=2, progress=False)
sweep.write(folder / "2nd_E2_K0.5_theta0.h5", study.config)

# %%
# Without ``bladerub``: any program that reads HDF5 will do. The variables have units and long names.

run = xr.open_dataset(folder / "0.3000.h5", engine="h5netcdf", phony_dims="sort")
run[["wear", "radial_displacement", "spectrum_amplitude"]]

# %%
# xarray plots with these names.

figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
run["wear"].mean("node", keep_attrs=True).plot(x="angle", ax=axes)
plt.show()

# %%
# With ``bladerub`` the file becomes the same object that a simulation returns, with its figures.

br.read_run(folder / "0.3000.h5").plot_history()

# %%
# A map holds all speeds of one coating, along the dimension ``f_omega``.

with xr.open_dataset(folder / "2nd_E2_K0.5_theta0.h5", engine="h5netcdf", phony_dims="sort") as found:
    worst = found["max_wear"].idxmax("f_omega").item()
    print(f"deepest wear at speed {worst:.2f}: {1e3 * found['max_wear'].max().item():.2f} mm")

br.read_map(folder / "2nd_E2_K0.5_theta0.h5").plot_wear()
