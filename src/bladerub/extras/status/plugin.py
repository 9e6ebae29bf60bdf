"""What of a study is done, counted on disk, and shown on a terminal while it is computed."""

COMMANDS = {"status": "extras.status.command"}
BARS = {"terminal": "extras.status.bar:Bar"}
