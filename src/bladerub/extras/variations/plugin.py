"""The study repeated with other inputs."""

SECTIONS = {"calibration": "extras.variations.settings:CALIBRATION"}
