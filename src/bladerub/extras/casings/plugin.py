"""Casings whose gap was measured."""

CASINGS = {"table": "extras.casings.measured"}
SECTIONS = {"casings.table": "extras.casings.settings:MeasuredCasing"}
