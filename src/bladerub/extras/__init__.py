"""Studies beside the paper's: chart, variations, sweeps, long runs, friction laws compared."""
