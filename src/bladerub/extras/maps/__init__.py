"""The map of one coating over the speed in Python: simulated, read from a study, drawn, as a table."""
