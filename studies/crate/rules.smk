# The study as an RO-Crate, to deposit: `snakemake crate -j1`. Not part of `all`.
CRATE = {
    "blade": "Reduced model and mesh of the blade",
    "maps": "Wear and spectra over the speed, a file for each coating",
    "tables": "Frequencies, peaks, divergence, verdicts on the claims; CSV with a description of each column",
    "figures": "Figures, PNG and PDF, with their data",
}


rule crate:
    input:
        lambda wildcards: rules.all.input,  # which is read after this file
    output:
        f"{RESULTS}/study.crate.zip",
    log:
        f"{RESULTS}/logs/crate.log",
    params:
        results=RESULTS,
        folders=CRATE,
    script:
        "scripts/crate.py"
