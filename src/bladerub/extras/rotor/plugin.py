"""Rows of blades."""

INVENTORIES = {"rows of blades": "extras.rotor.inventory:inventories"}
