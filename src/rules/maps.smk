# Stage 3: the tables over all coatings.
from bladerub.study.peaks import peak_orders, used_casings

# What decides the table of the peaks: the orders of a casing of its own, if it has any, besides those of all
PEAKS = config["analysis"]["peaks"] | {
    name: peak_orders(STUDY, name)
    for name in used_casings(STUDY)
    if peak_orders(STUDY, name) != config["analysis"]["peaks"]["orders"]
}
# A row for each peak, and for each run whether it diverges
for name, module, settings in (
    ("peaks", "study.peaks", PEAKS),
    ("divergence", "study.divergence", config["analysis"]["divergence"]),
):

    rule:
        name:
            name
        input:
            blade=rules.blade.output.reduced_model,
            maps=expand(rules.coating.output.map, coating=COATINGS),
            analysing=files_behind(module),
        output:
            **described(table=f"{TABLES}/{name}.csv"),
        log:
            f"{RESULTS}/logs/{name}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{name}.tsv"
        group:
            "drawing"
        params:
            settings=settings,
        script:
            "../scripts/map_table.py"


rule findings:
    input:
        maps=expand(rules.coating.output.map, coating=COATINGS),
        peaks=rules.peaks.output[0],
        divergence=rules.divergence.output[0],
        rom_accuracy=rules.blade_tables.output.rom_accuracy,
        analysing=files_behind("study.findings"),
    output:
        **described(table=shown(f"{TABLES}/findings.csv", "findings", "Claims")),
    log:
        f"{RESULTS}/logs/findings.log",
    benchmark:
        f"{RESULTS}/benchmarks/findings.tsv"
    group:
        "drawing"
    script:
        "../scripts/findings.py"


# The paper speaks of its own blade: one from another program is not judged by its claims
JUDGED = [] if "source" in config["blade"] else [rules.findings.output]
