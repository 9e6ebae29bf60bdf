"""The stress of the blade in a run."""

MEASURES = {"stress": "extras.stress.run"}
