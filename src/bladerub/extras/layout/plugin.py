"""A folder with a study of one's own."""

COMMANDS = {"new": "extras.layout.command"}
