"""Figures of the extensions, in the style of `bladerub.plots`."""
