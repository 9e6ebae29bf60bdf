"""A coating fitted to stress-strain curves."""

PUBLIC = {"fit_coating": "extras.fit.fit"}
COMMANDS = {"fit-coating": "extras.fit.command"}
