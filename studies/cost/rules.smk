# What the study cost: made last, from the records that Snakemake keeps of the other jobs.

MEASURED = f"{RESULTS}/benchmarks"  # all that differs from one execution to the next


rule cost:
    input:
        # not for what is in them: any job that was repeated may have another cost
        rules.peaks.output,
        rules.divergence.output,
        FIGURES,
        JUDGED,
        lambda wildcards: [path for name, paths in ADDED_TO_ALL.items() if name != "cost" for path in paths],
        maps=expand(rules.coating.output.map, coating=COATINGS),
        collecting=files_behind("extras.cost.jobs"),
    output:
        **described(table=f"{MEASURED}/cost.csv"),
        png=shown(f"{MEASURED}/cost.png", "cost", "7. Cost"),
        pdf=f"{MEASURED}/cost.pdf",
    log:
        f"{RESULTS}/logs/cost.log",
    group:
        "drawing"
    params:
        benchmarks=MEASURED,
        added=lambda wildcards: [name for name in ADDED_TO_ALL if name != "cost"],
        dpi=DPI,
    script:
        "scripts/cost.py"


ADDED_TO_ALL["cost"] = rules.cost.output
