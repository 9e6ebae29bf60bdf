# The largest stress of the blade at the peaks. Not part of `all`.


rule stress:
    input:
        **SIMULATING,
        mesh=rules.blade.output.mesh,
        peaks=rules.peaks.output[0],
        code=files_behind("extras.stress.run", "extras.plots.studies"),
    output:
        **drawn("stress_peaks", "6. Sweeps and long runs"),
        **described(table=shown(f"{TABLES}/stress.csv", "stress", "6. Sweeps and long runs")),
    log:
        f"{RESULTS}/logs/stress.log",
    resources:
        runtime=minutes(20),
    params:
        dpi=DPI,
    script:
        "scripts/stress.py"
