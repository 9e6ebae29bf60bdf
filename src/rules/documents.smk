# What the repository shows of itself, all committed: pictures, reference of the config, tables that pages quote. Not
# part of `all`.
from pathlib import Path

IMAGES = [
    Path(path).name
    for output in FIGURES
    for path in output
    if path.endswith(".png") and Path(path).parent == Path(PLOTS)
]


rule images:
    input:
        [f"{PLOTS}/{name}" for name in IMAGES],
    output:
        [f"docs/images/{name}" for name in IMAGES],
    log:
        f"{RESULTS}/logs/images.log",
    params:
        colours=48,
        few=[f"docs/images/{name}" for name in IMAGES if "history" in name],  # lines
    script:
        script_of("images")


rule config_reference:
    input:
        config="config/config.yaml",
        settings=[
            path.relative_to(ROOT).as_posix()
            for path in ROOT.glob("src/bladerub/**/settings.py")
        ],
        page="docs/config_keys.py",
        writing=files_behind("config.keys"),
    output:
        reference="docs/config.md",
        schema="config/schema.json",
    log:
        f"{RESULTS}/logs/config_reference.log",
    script:
        "../scripts/config_reference.py"


# Without an output: it takes snapshots anew whenever it is asked for, those of the pages of studies/ as well
rule docs_data:
    input:
        expand(
            f"{TABLES}/{{name}}.csv",
            name=[
                "findings",
                "peaks",
                "divergence",
                "rom_accuracy",
                "campbell",
            ],
        ),
        f"{TABLES}/margins.csv",  # of the study `variations`
        f"{RESULTS}/benchmarks/cost.csv",  # of the study `cost`
    log:
        f"{RESULTS}/logs/docs_data.log",
    params:
        results=RESULTS,
    script:
        script_of("docs_data")
