"""Rows of blades."""

NEEDS = ("rows",)
INVENTORIES = {"rows of blades": "extras.rotor.plan:inventories"}
