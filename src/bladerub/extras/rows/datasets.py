"""What a run file holds of a row of blades."""

DATASETS = {
    "row": ((), "1", "the row of blades, as bladerub.Row.from_json reads it"),
    "blade": (("blade",), "1", "number of the blade in the row, counted from 1"),
    "blade_angle": (("blade",), "rad", "angle by which the blade is ahead of the start"),
    "blade_length": (("blade",), "m", "tip radius of the blade beyond the nominal one"),
    "blade_frequency": (("blade",), "1", "relative deviation of the first frequency of the blade"),
    "blade_damping": (("blade",), "1", "damping ratio of the blade over that of the run"),
    "blade_peak": (("blade",), "m", "largest absolute radial displacement of node 1, last revolutions"),
    "blade_amplitude": (
        ("blade",),
        "m",
        "largest half range of the radial displacement of node 1 in a revolution, last revolutions",
    ),
    "blade_worn_volume": (("blade",), "m3", "volume of coating that the blade has worn off"),
    "blade_unbounded": (("blade",), "1", "1 where the blade left the displacement limit"),
    "blade_energy_residual": (("blade",), "1", "what the ledger of the blade misses, without the disk"),
}
"""Dimensions, unit and meaning of each dataset, by its name."""

OF_BLADES = tuple(name for name in DATASETS if name.startswith("blade_"))
"""Those with a number for each blade."""
