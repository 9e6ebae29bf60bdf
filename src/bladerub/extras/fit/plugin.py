"""A coating fitted to stress-strain curves."""

PUBLIC = {"fit_coating": "extras.fit.interface"}
COMMANDS = {"fit-coating": "extras.fit.command"}
