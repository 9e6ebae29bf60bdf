# What the study cost: made last, from the records that Snakemake keeps of the other jobs.


rule cost:
    input:
        # not for what is in them: any job that was repeated may have another cost
        rules.peaks.output,
        rules.divergence.output,
        FIGURES,
        JUDGED,
        rules.explorer.output,
        maps=expand(rules.map.output, coating=COATINGS),
        collecting=files_behind("workflow.cost", "workflow.schedule"),
        drawing=files_behind("plots.cost"),
    output:
        **described(table=f"{TABLES}/cost.csv", schedule=f"{TABLES}/schedule.csv"),
        png=shown(f"{RESULTS}/benchmarks/cost.png", "cost", "Cost"),
        pdf=f"{RESULTS}/benchmarks/cost.pdf",
    log:
        f"{RESULTS}/logs/cost.log",
    params:
        benchmarks=f"{RESULTS}/benchmarks",
        dpi=DPI,
    script:
        "../scripts/cost.py"
