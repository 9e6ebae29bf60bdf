"""The stress of the blade in a run."""

MEASURES = {"stress": "extras.stress.run"}
RUN_OPTIONS = {"stress": "extras.stress.run_option:StressOption"}
