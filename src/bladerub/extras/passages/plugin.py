"""Speed sweeps and long runs."""

SECTIONS = {"sweeps": "extras.passages.settings:SWEEPS", "long_runs": "extras.passages.settings:LONG_RUNS"}
