"""What the blades of the tests are made of."""

TITANIUM = {"young_modulus": 110e9, "poisson_ratio": 0.32, "density": 4430.0}


def section(span, **changes):
    standard = {"chord": 0.08, "thickness": 0.08, "camber": 0.0, "stagger": 0.0, "sweep": 0.0, "lean": 0.0}
    return {"span": span, **standard, **changes}
