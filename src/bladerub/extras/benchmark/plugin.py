"""The speed of the time loop."""

COMMANDS = {"benchmark": "extras.benchmark.command"}
