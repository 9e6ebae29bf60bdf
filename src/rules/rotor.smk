# Rows of blades on one coating (docs/explanation/rotor.md). Not part of `all`.
from functools import cache

ROTOR = "config/rotor.yaml"
OF_ROWS = f"{RESULTS}/rotor/runs"


@cache
def rotor_plan():
    """The plan; read and checked only when somebody asks for the rows."""
    from bladerub.extensions.rotor.plan import read_plan

    with bladerub.io.errors.exit_on_error():
        return read_plan(ROTOR, config)


@cache
def rotor_runs(combination):
    """The draws of a combination, as planned runs."""
    with bladerub.io.errors.exit_on_error():
        return rotor_plan().runs(config, combination).runs


def planned_rows(wildcards):
    """All that determines the rows but the blade: a changed one is a reason to run."""
    return {run.file: run.determinants for run in rotor_runs(wildcards.combination)}


def rotor_minutes(wildcards, attempt):
    """As `coating_minutes`, over the blades of the rows."""
    runs = rotor_runs(wildcards.combination)
    revolutions = sum(run.spec.revolutions * len(run.row.blades) for run in runs)
    return attempt * math.ceil((60 + 0.03 * revolutions) / 60)


# As `coating`: the runs are next to the manifest, undeclared
rule rotor_combination:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
    output:
        f"{OF_ROWS}/{{combination}}/manifest.tsv",
    log:
        f"{RESULTS}/logs/rotor_combination/{{combination}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/rotor_combination/{{combination}}.tsv"
    resources:
        mem_mb=memory_mb,
        runtime=rotor_minutes,
    params:
        folder=subpath(output[0], parent=True),
        plan=ROTOR,
        planned=planned_rows,
    script:
        "../scripts/rotor_combination.py"


def rotor_manifests(wildcards):
    return [f"{OF_ROWS}/{name}/manifest.tsv" for name in rotor_plan().combinations]


rule rotor_tables:
    input:
        manifests=rotor_manifests,
        plan=ROTOR,
        analysing=files_behind("extensions.rotor.summary"),
        drawing=files_behind("extensions.plots.rotor", "plots.titles"),
    output:
        **drawn("rotor", "Sweeps and long runs"),
        **described(
            table=shown(f"{TABLES}/rotor.csv", "rotor_table", "Sweeps and long runs"),
            draws=f"{TABLES}/rotor_draws.csv",
        ),
    log:
        f"{RESULTS}/logs/rotor_tables.log",
    benchmark:
        f"{RESULTS}/benchmarks/rotor_tables.tsv"
    params:
        folder=OF_ROWS,
        dpi=DPI,
    script:
        "../scripts/rotor_tables.py"


localrules:
    rotor,


rule rotor:
    input:
        rotor_manifests,  # Snakemake replaces no lost one for a table that is there
        rules.rotor_tables.output,
