"""The Python interface: studies, blades, runs and maps as objects. `bladerub` exports its names."""
