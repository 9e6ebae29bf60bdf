"""Figures that the paper does not have."""

PUBLIC = {"plot_spectra": "extras.plots.spectra"}
