"""Units of length and of angle by name, in SI."""

import numpy as np

UNITS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "inch": 0.0254, "feet": 0.3048}
UNITS |= {"in": UNITS["inch"], "ft": UNITS["feet"]}  # m
ANGLE_UNITS = {"rad": 1.0, "deg": np.pi / 180}  # rad
