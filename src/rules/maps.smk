# Stages 3 and 4: what the runs of a coating show together, and the tables over all coatings.
import csv
import os


rule map:
    input:
        manifest=rules.coating.output[0],
        blade=f"{RESULTS}/blade/reduced_model.h5",
        analysing=files_behind("study.maps", "study.wear"),
    output:
        f"{RESULTS}/maps/{{coating}}.h5",
    log:
        f"{RESULTS}/logs/map/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/map/{{coating}}.tsv"
    threads: 1
    params:
        lobe_prominence=config["analysis"]["lobe_prominence"],
    script:
        "../scripts/map.py"


rule peaks:
    input:
        maps=expand(rules.map.output, coating=COATINGS),
        analysing=files_behind("study.peaks"),
    output:
        f"{RESULTS}/tables/peaks.csv",
        description=f"{RESULTS}/tables/peaks.csv-metadata.json",
    log:
        f"{RESULTS}/logs/peaks.log",
    benchmark:
        f"{RESULTS}/benchmarks/peaks.tsv"
    threads: 1
    params:
        peaks=config["analysis"]["peaks"],
    script:
        "../scripts/peaks.py"


rule divergence:
    input:
        maps=expand(rules.map.output, coating=COATINGS),
        analysing=files_behind("study.divergence", "study.growth"),
    output:
        f"{RESULTS}/tables/divergence.csv",
        description=f"{RESULTS}/tables/divergence.csv-metadata.json",
    log:
        f"{RESULTS}/logs/divergence.log",
    benchmark:
        f"{RESULTS}/benchmarks/divergence.tsv"
    threads: 1
    params:
        divergence=config["analysis"]["divergence"],
    script:
        "../scripts/divergence.py"


def reported_robustness(wildcards):
    """Reference and share of each claim, if `snakemake robustness` was run: the study does not wait for it."""
    if not os.path.exists(f"{RESULTS}/tables/robustness.csv"):
        return {}
    with open(
        f"{RESULTS}/tables/robustness.csv", encoding="utf-8", newline=""
    ) as lines:
        return {
            row["id"]: (row["reference"], float(row["yes_share"] or "nan"))
            for row in csv.DictReader(lines)
        }


rule findings:
    input:
        maps=expand(rules.map.output, coating=COATINGS),
        peaks=rules.peaks.output[0],
        divergence=rules.divergence.output[0],
        rom_accuracy=f"{RESULTS}/tables/rom_accuracy.csv",
        analysing=files_behind("study.findings"),
    output:
        shown(f"{RESULTS}/tables/findings.csv", "findings", "Claims"),
        description=f"{RESULTS}/tables/findings.csv-metadata.json",
    log:
        f"{RESULTS}/logs/findings.log",
    benchmark:
        f"{RESULTS}/benchmarks/findings.tsv"
    threads: 1
    params:
        robustness=reported_robustness,
    script:
        "../scripts/findings.py"
