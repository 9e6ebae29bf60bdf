"""What of a study is done, counted on disk."""

COMMANDS = {"status": "extras.status.command"}
