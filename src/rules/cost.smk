# What the study cost: made last, from the records that Snakemake keeps of the other jobs.


rule cost:
    input:
        # whatever gathers or draws comes first, but does not by itself make the costs anew
        ancient([rules.peaks.output, rules.divergence.output, rules.findings.output]),
        ancient(FIGURES),
        maps=expand(rules.map.output, coating=COATINGS),
        gathering="src/bladerub/study/cost.py",
        drawing=drawing("cost"),
    output:
        table=f"{RESULTS}/tables/cost.csv",
        png=f"{PLOTS}/cost.png",
        pdf=f"{PLOTS}/cost.pdf",
    log:
        f"{RESULTS}/logs/cost.log",
    threads: 1
    params:
        benchmarks=f"{RESULTS}/benchmarks",
        dpi=DPI,
    script:
        "../scripts/cost.py"
