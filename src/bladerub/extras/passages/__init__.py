"""Speed sweeps and long runs."""
