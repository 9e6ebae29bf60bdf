# Stage 1: the blade, built once: finite elements, reduction, accuracy of the reduction.
from pathlib import Path

from bladerub.blade.files import is_built, missing_file, without_defaults
from bladerub.blade.source import files, modules
from bladerub.io.errors import DamagedFile
from bladerub.workflow.invocation import damage, loss, replaces

REDUCED_MODEL = f"{RESULTS}/blade/reduced_model.h5"
MESH = f"{RESULTS}/blade/mesh.h5"


def of_another_config(model):
    """Say so of a blade that `bladerub run` has left here: Snakemake has no record of how it was made."""
    if lost := missing_file(Path(model)):
        return f"{lost}: missing" if Path(model).exists() else None
    try:
        is_current = is_built(STUDY, Path(model))
    except DamagedFile as error:
        return str(error)
    return None if is_current else f"{model}: of another config"


rule blade:
    input:
        replaces(workflow, REDUCED_MODEL, of_another_config),
        replaces(workflow, REDUCED_MODEL, damage),
        replaces(workflow, MESH, damage),
        code=files_behind(*modules(STUDY)),
        given=files(STUDY.blade),
    output:
        **described(rom_accuracy=f"{RESULTS}/blade/rom_accuracy.csv"),
        reduced_model=REDUCED_MODEL,
        mesh=MESH,
    log:
        f"{RESULTS}/logs/blade.log",
    benchmark:
        f"{RESULTS}/benchmarks/blade.tsv"
    resources:
        runtime=minutes(10),
    params:
        blade=config["blade"],
        reduction=without_defaults(config["reduction"]),
    script:
        script_of("blade")


# of a rule of its own: who deletes the folder of the tables has no blade to build
rule blade_tables:
    input:
        rules.blade.output.rom_accuracy,
    output:
        **described(
            campbell=f"{TABLES}/campbell.csv",
            rom_accuracy=f"{TABLES}/rom_accuracy.csv",
        ),
    log:
        f"{RESULTS}/logs/blade_tables.log",
    group:
        "drawing"
    script:
        "../scripts/blade_tables.py"
