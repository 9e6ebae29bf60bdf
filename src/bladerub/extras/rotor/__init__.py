"""Rows of blades: the share of the wear and of the vibration that each of many different blades bears."""
