"""A finished study on one page, in the units of the machine."""

COMMANDS = {"report": "extras.report.command"}
NEEDS = ("records",)
