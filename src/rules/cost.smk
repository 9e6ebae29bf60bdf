# What the study cost: made last, from the records that Snakemake keeps of the other jobs.

MEASURED = f"{RESULTS}/benchmarks"  # all that differs from one execution to the next


rule cost:
    input:
        # not for what is in them: any job that was repeated may have another cost
        rules.peaks.output,
        rules.divergence.output,
        FIGURES,
        JUDGED,
        lambda wildcards: [path for paths in ADDED_TO_ALL.values() for path in paths],
        maps=expand(rules.map.output, coating=COATINGS),
        collecting=files_behind("workflow.cost", "workflow.schedule"),
        drawing=files_behind("plots.cost"),
    output:
        **described(table=f"{MEASURED}/cost.csv", schedule=f"{MEASURED}/schedule.csv"),
        png=shown(f"{MEASURED}/cost.png", "cost", "Cost"),
        pdf=f"{MEASURED}/cost.pdf",
    log:
        f"{RESULTS}/logs/cost.log",
    params:
        benchmarks=MEASURED,
        added=lambda wildcards: list(ADDED_TO_ALL),
        dpi=DPI,
    script:
        "../scripts/cost.py"
