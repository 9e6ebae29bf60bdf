# The runs at the peaks, and those that claims name, repeated from slightly different starts: the bands of peaks, runs
# and verdicts. Part of `all` unless the config wants no members.
ENSEMBLE = f"{RESULTS}/ensembles/{{coating}}.h5"
MEMBERS = f"{RESULTS}/runs/{{coating}}/ensemble/manifest.tsv"


rule ensemble:
    # The members are next to their manifest, undeclared, as the runs of a coating are
    input:
        replaces(workflow, ENSEMBLE, damage),
        replaces(workflow, MEMBERS),
        **SIMULATING,
        map=rules.coating.output.map,
        analysing=files_behind("extras.ensembles.ensemble", "study.maps"),
    output:
        ENSEMBLE,
        members=MEMBERS,
    log:
        f"{RESULTS}/logs/ensemble/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/ensemble/{{coating}}.tsv"
    priority: 1  # above those of coatings: the longest job of the study is one of these
    group:
        "rubs"
    threads: lambda wildcards: threads_of("ensemble", wildcards.coating)
    resources:
        runtime=coating_minutes,
    params:
        folder=f"{RESULTS}/runs/{{coating}}",
        ensemble=config["ensemble"],
        peaks=PEAKS,
        divergence=config["analysis"]["divergence"],
    script:
        "scripts/ensemble.py"


BANDS, VERDICTS = {"peaks": "peak_bands", "runs": "run_bands"}, {}
if JUDGED:
    BANDS["claims"] = "claim_draws"
    VERDICTS = {"findings": rules.findings.output[0], "rom_accuracy": rules.blade_tables.output.rom_accuracy}


rule bands:
    input:
        **VERDICTS,
        maps=expand(rules.coating.output.map, coating=COATINGS),
        ensembles=expand(ENSEMBLE, coating=COATINGS),
        analysing=files_behind("extras.ensembles.bands", "study.findings"),
    output:
        **described(**{kind: f"{TABLES}/{name}.csv" for kind, name in BANDS.items()}),
    log:
        f"{RESULTS}/logs/bands.log",
    benchmark:
        f"{RESULTS}/benchmarks/bands.tsv"
    group:
        "drawing"
    params:
        peaks=PEAKS,
        divergence=config["analysis"]["divergence"],
    script:
        "scripts/bands.py"


rule peak_bands:
    input:
        peaks=rules.bands.output.peaks,
        drawing=files_behind("extras.ensembles.figure", "plots.histogram"),
    output:
        **drawn("peak_bands", "Moduli of the coating"),
    log:
        f"{RESULTS}/logs/peak_bands.log",
    benchmark:
        f"{RESULTS}/benchmarks/peak_bands.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        coatings=MODULI,
        modulus_unit=modulus_unit(STUDY),
    script:
        "scripts/peak_bands.py"


if config["ensemble"]["members"]:
    # the tables need the members, but Snakemake replaces no lost one for an ensemble that is there
    ADDED_TO_ALL["ensemble"] = expand(rules.ensemble.output, coating=COATINGS)
    ADDED_TO_ALL["bands"] = rules.bands.output
    if WITH_MODULI:
        ADDED_TO_ALL["peak_bands"] = rules.peak_bands.output
