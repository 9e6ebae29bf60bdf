# How much the width of the coating's bars decides at the peaks of some coatings. Not part of `all`.


rule finer_bars:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        peaks=rules.peaks.output[0],
        analysing=files_behind("verification.finer_bars"),
    output:
        **described(table=f"{TABLES}/finer_bars.csv"),
    log:
        f"{RESULTS}/logs/finer_bars.log",
    benchmark:
        f"{RESULTS}/benchmarks/finer_bars.tsv"
    resources:
        runtime=minutes(5),
    script:
        "../scripts/finer_bars.py"
