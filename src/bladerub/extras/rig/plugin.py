"""A rigid or an elastic blade on a coated disk."""

PUBLIC = {"Rig": "extras.rig.spec", "simulate_rig": "extras.rig.blade"}
