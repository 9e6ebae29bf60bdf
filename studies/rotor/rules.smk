# Rows of blades on one coating (studies/rotor/README.md). Not part of `all`.
from functools import cache

from bladerub.extras.rotor.plan import PLAN, RUNS, read_plan

ROTOR = PLAN.as_posix()
OF_ROWS = f"{RESULTS}/{RUNS.as_posix()}"


@cache
def rotor_plan():
    """The plan; read and checked only when somebody asks for the rows."""
    with bladerub.io.errors.exit_on_error():
        return read_plan(ROTOR, STUDY)


@cache
def rotor_runs(combination):
    """The draws of a combination, as planned runs."""
    with bladerub.io.errors.exit_on_error():
        return rotor_plan().runs(STUDY, combination)


ROW_MANIFEST = f"{OF_ROWS}/{{combination}}/manifest.tsv"


# As `coating`: the runs are next to the manifest, undeclared
rule rotor_combination:
    input:
        replaces(workflow, ROW_MANIFEST),
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
    output:
        manifest=ROW_MANIFEST,
    log:
        f"{RESULTS}/logs/rotor_combination/{{combination}}.log",
    resources:
        runtime=lambda wildcards, attempt: minutes_for(rotor_runs(wildcards.combination).runs, attempt),
    params:
        folder=subpath(output.manifest, parent=True),
        plan=lambda wildcards: rotor_runs(wildcards.combination),
        # all that determines the rows but the blade: a changed one is a reason to run
        planned=lambda wildcards: {
            run.file: run.determinants for run in rotor_runs(wildcards.combination).runs
        },
    script:
        script_of("coating")


def rotor_manifests(wildcards):
    return expand(ROW_MANIFEST, combination=rotor_plan().combinations)


rule rotor_tables:
    input:
        manifests=rotor_manifests,
        plan=ROTOR,
        analysing=files_behind("extras.rotor.summary"),
    output:
        **described(
            table=shown(f"{TABLES}/rotor.csv", "rotor_table", "6. Sweeps and long runs"),
            half=f"{TABLES}/rotor_half.csv",
            draws=f"{TABLES}/rotor_draws.csv",
        ),
    log:
        f"{RESULTS}/logs/rotor_tables.log",
    params:
        folder=OF_ROWS,
        analysis=config["analysis"],
    script:
        "scripts/rotor_tables.py"


# Rows whose wear is looked at every few revolutions; first of all, since it is one long job
rule rotor_patterns:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        plan=ROTOR,
        computing=files_behind("extras.rotor.summary"),
    output:
        **described(
            table=f"{TABLES}/rotor_patterns.csv",
            drift=shown(f"{TABLES}/rotor_drift.csv", "rotor_drift", "6. Sweeps and long runs"),
        ),
    log:
        f"{RESULTS}/logs/rotor_patterns.log",
    priority: 1
    params:
        patterns=lambda wildcards: rotor_plan().patterns,
        simulated=lambda wildcards: [
            asdict(run_spec(STUDY, combination.case, combination.f_omega))
            for combination in rotor_plan().followed
        ],
    script:
        "scripts/rotor_patterns.py"


# `rotor` of all combinations, `rotor_sweeps` of those that are swept
rule rotor_figure:
    input:
        table=rules.rotor_tables.output.table,
        plan=ROTOR,
        drawing=files_behind("extras.plots.rotor", "plots.titles"),
    output:
        **drawn("rotor", "6. Sweeps and long runs"),
    log:
        f"{RESULTS}/logs/rotor_figure.log",
    params:
        dpi=DPI,
    script:
        "scripts/rotor_figure.py"


use rule rotor_figure as rotor_sweeps_figure with:
    output:
        **drawn("rotor_sweeps", "6. Sweeps and long runs"),
    log:
        f"{RESULTS}/logs/rotor_sweeps_figure.log",


rule rotor:
    input:
        rotor_manifests,  # Snakemake replaces no lost one for a table that is there
        rules.rotor_tables.output,
        rules.rotor_figure.output,
        lambda wildcards: rules.rotor_sweeps_figure.output if rotor_plan().swept else [],
        lambda wildcards: rules.rotor_patterns.output if rotor_plan().patterns else [],
    localrule: True


PICTURES["rotor_image"] = {
    f"studies/rotor/images/{name}.png": Picture(f"{PLOTS}/{name}.png", 64, 2)
    for name in ("rotor", "rotor_sweeps")
}
