# How far the analysis itself decides the verdicts: the claims, judged again on parts of the study.


rule margins:
    input:
        maps=expand(rules.coating.output.map, coating=COATINGS),
        rom_accuracy=rules.blade_tables.output.rom_accuracy,
        analysing=files_behind("study.margins"),
        drawing=files_behind("plots.verdicts"),
    output:
        **drawn("margins", "Claims"),
        **described(table=shown(f"{TABLES}/margins.csv", "margins_table", "Claims")),
    log:
        f"{RESULTS}/logs/margins.log",
    benchmark:
        f"{RESULTS}/benchmarks/margins.tsv"
    params:
        analysis=config["analysis"] | {"peaks": PEAKS},
        speeds=config["speeds"],
        dpi=DPI,
    script:
        "../scripts/margins.py"


# The paper speaks of its own blade: one from another program is not judged by its claims
JUDGED = (
    [] if "source" in config["blade"] else [rules.findings.output, rules.margins.output]
)
