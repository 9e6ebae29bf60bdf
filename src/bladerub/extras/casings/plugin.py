"""Casings whose gap was measured."""

CASINGS = {"table": "extras.casings.measured"}
