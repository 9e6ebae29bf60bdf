"""The coating chart: peaks, wear and divergence over a dense grid of E and K, at few but chosen speeds.

The chart (``config.chart``) shares blade, solver and speeds with the study, but keeps of each run only
what it shows: one file per coating, a *point* of the chart; one job per *column*, all K at one E and θ.
"""
