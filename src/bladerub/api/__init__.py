"""The Python interface: studies, blades and runs as objects. `bladerub` exports its names."""
