"""Rows of blades."""

NEEDS = ("rows",)
INVENTORIES = {"rows of blades": "extras.rotor.inventory:inventories"}
