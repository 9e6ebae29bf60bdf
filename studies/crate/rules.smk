# The study as an RO-Crate, to deposit: `snakemake crate -j1`. Not part of `all`.


rule crate:
    input:
        lambda wildcards: rules.all.input,  # which is read after this file
    output:
        f"{RESULTS}/study.crate.zip",
    log:
        f"{RESULTS}/logs/crate.log",
    params:
        results=RESULTS,
    script:
        "scripts/crate.py"
