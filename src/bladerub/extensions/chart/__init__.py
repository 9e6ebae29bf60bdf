"""The coating chart: peaks, wear and divergence over a dense grid of E and K, at few but chosen speeds.

It lies beside the study (``config["chart"]``) and shares its blade, its solver and its speeds, but keeps of
each run only what the chart shows: one file a coating, a *cell*; one job a *column*, all K at one E and θ.
"""
