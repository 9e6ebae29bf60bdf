# How far the analysis itself decides the answers: the claims, put again to parts of the study.


rule margins:
    input:
        maps=expand(rules.map.output, coating=COATINGS),
        rom_accuracy=f"{RESULTS}/tables/rom_accuracy.csv",
        judging=rules.findings.input.analysing,
        analysing=files_behind("study.margins", "study.divergence", "study.growth"),
        drawing=files_behind("plots.verdicts"),
    output:
        **drawn("margins", "Claims"),
        table=shown(f"{RESULTS}/tables/margins.csv", "margins_table", "Claims"),
        description=f"{RESULTS}/tables/margins.csv-metadata.json",
    log:
        f"{RESULTS}/logs/margins.log",
    benchmark:
        f"{RESULTS}/benchmarks/margins.tsv"
    threads: 1
    params:
        analysis=config["analysis"],
        speeds=config["speeds"],
        dpi=DPI,
    script:
        "../scripts/margins.py"
