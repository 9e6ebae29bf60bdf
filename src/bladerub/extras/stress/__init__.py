"""The largest stress of the blade in a run, and at the peaks of the study."""
