"""Files for other programs."""

COMMANDS = {"export": "extras.export.command"}
