# What the study cost: made last, from the records that Snakemake keeps of the other jobs.


rule cost:
    input:
        # not for what is in them: any job done anew may have another cost
        rules.peaks.output,
        rules.divergence.output,
        rules.findings.output,
        FIGURES,
        rules.margins.output,
        rules.explorer.output,
        maps=expand(rules.map.output, coating=COATINGS),
        gathering="src/bladerub/workflow/cost.py",
        drawing=files_behind("plots.cost"),
    output:
        table=f"{RESULTS}/tables/cost.csv",
        png=shown(f"{RESULTS}/benchmarks/cost.png", "cost", "Cost"),
        description=f"{RESULTS}/tables/cost.csv-metadata.json",
        pdf=f"{RESULTS}/benchmarks/cost.pdf",
    log:
        f"{RESULTS}/logs/cost.log",
    threads: 1
    params:
        benchmarks=f"{RESULTS}/benchmarks",
        dpi=DPI,
    script:
        "../scripts/cost.py"
