"""Studies beside the paper's: chart, robustness, calibration, sweeps, long runs, friction laws compared."""
