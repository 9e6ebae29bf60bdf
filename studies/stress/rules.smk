# The largest stress of the blade at the peaks. Not part of `all`.


rule stress:
    input:
        blade=rules.blade.output.reduced_model,
        mesh=rules.blade.output.mesh,
        kernel=rules.compile_kernel.output[0],
        peaks=rules.peaks.output[0],
        analysing=files_behind("extras.stress.table"),
        drawing=files_behind("extras.plots.stress"),
    output:
        **drawn("stress_peaks", "6. Sweeps and long runs"),
        **described(
            table=shown(f"{TABLES}/stress.csv", "stress", "6. Sweeps and long runs"),
        ),
    log:
        f"{RESULTS}/logs/stress.log",
    resources:
        mem_mb=memory_mb,
        runtime=minutes(20),
    params:
        dpi=DPI,
    script:
        "scripts/stress.py"
