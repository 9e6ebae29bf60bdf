"""What the paper leaves open, varied."""

SECTIONS = {"calibration": "extras.calibration.settings:CALIBRATION"}
