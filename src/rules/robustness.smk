# How far the claims depend on what the paper leaves open (docs/robustness.md). Not part of `all`.
from functools import cache

ROBUSTNESS = "config/robustness.yaml"
OF_SAMPLES = f"{RESULTS}/robustness"


@cache
def robustness_plan():
    """The plan; read and checked only when somebody asks for the robustness."""
    from bladerub.study.robustness.design import check
    from bladerub.study.robustness.plan import read_plan

    with bladerub.faults.end_the_program():
        plan = read_plan(ROBUSTNESS)
        if workflow.is_main_process:
            check(config, plan)
    return plan


@cache
def robustness_samples(part):
    """The config of every sample of a part."""
    from bladerub.study.robustness.design import sample_configs

    with bladerub.faults.end_the_program():
        return sample_configs(config, robustness_plan(), robustness_plan().parts[part])


@cache
def robustness_blades():
    """One sample that has it, for each of the blades by name."""
    from bladerub.study.robustness.design import blade_name

    return {
        blade_name(sample): sample
        for part in robustness_plan().parts
        for sample in robustness_samples(part)
    }


def robustness_batch(wildcards):
    """The samples of one job by their numbers."""
    batch = robustness_plan().parts[wildcards.part].batches()[int(wildcards.batch)]
    return {number: robustness_samples(wildcards.part)[number] for number in batch}


def robustness_batch_blades(wildcards):
    from bladerub.study.robustness.design import blade_name

    return [
        f"{OF_SAMPLES}/blades/{blade_name(sample)}/{name}"
        for sample in robustness_batch(wildcards).values()
        for name in ("reduced_model.h5", "rom_accuracy.csv")
    ]


def robustness_batches(file):
    """What all jobs write under the name `file`."""

    def paths(wildcards):
        return [
            f"{OF_SAMPLES}/{part.name}/{number}/{file}"
            for part in robustness_plan().parts.values()
            for number in range(len(part.batches()))
        ]

    return paths


use rule blade as robustness_blade with:
    output:
        reduced_model=f"{OF_SAMPLES}/blades/{{blade}}/reduced_model.h5",
        mesh=f"{OF_SAMPLES}/blades/{{blade}}/mesh.h5",
        campbell=f"{OF_SAMPLES}/blades/{{blade}}/campbell.csv",
        rom_accuracy=f"{OF_SAMPLES}/blades/{{blade}}/rom_accuracy.csv",
        descriptions=[
            f"{OF_SAMPLES}/blades/{{blade}}/{name}.csv-metadata.json"
            for name in ("campbell", "rom_accuracy")
        ],
    log:
        f"{RESULTS}/logs/robustness_blade/{{blade}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/robustness_blade/{{blade}}.tsv"
    params:
        blade=lambda wildcards: robustness_blades()[wildcards.blade]["blade"],
        reduction=lambda wildcards: robustness_blades()[wildcards.blade]["reduction"],


rule robustness_batch:
    input:
        blades=robustness_batch_blades,
        kernel=rules.compile_kernel.output[0],
        analysing=[
            *rules.map.input.analysing,
            *rules.peaks.input.analysing,
            *rules.divergence.input.analysing,
            *rules.findings.input.analysing,
            *analysing("small", "robustness/sample"),
        ],
    output:
        verdicts=f"{OF_SAMPLES}/{{part}}/{{batch}}/verdicts.csv",
        verdicts_description=f"{OF_SAMPLES}/{{part}}/{{batch}}/verdicts.csv-metadata.json",
        cost=f"{OF_SAMPLES}/{{part}}/{{batch}}/cost.csv",
        cost_description=f"{OF_SAMPLES}/{{part}}/{{batch}}/cost.csv-metadata.json",
    log:
        f"{RESULTS}/logs/robustness_batch/{{part}}_{{batch}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/robustness_batch/{{part}}_{{batch}}.tsv"
    wildcard_constraints:
        part="[A-Za-z][A-Za-z0-9_]*",
        batch="[0-9]+",
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2000 * attempt,
        runtime=lambda wildcards, attempt: 60 * attempt,  # a tenth of it measured
    params:
        samples=robustness_batch,
        claims=lambda wildcards: robustness_plan().parts[wildcards.part].claims,
    script:
        "../scripts/robustness_batch.py"


rule robustness:
    input:
        verdicts=robustness_batches("verdicts.csv"),
        cost=robustness_batches("cost.csv"),
        plan=ROBUSTNESS,
        analysing=[
            "src/bladerub/study/findings/__init__.py",
            *analysing(
                "robustness/plan", "robustness/sensitivity", "robustness/summary"
            ),
        ],
        drawing=drawing("robustness"),
    output:
        **drawn("robustness", "Claims"),
        table=shown(f"{RESULTS}/tables/robustness.csv", "robustness_table", "Claims"),
        indices=f"{RESULTS}/tables/robustness_indices.csv",
        verdicts=f"{RESULTS}/tables/robustness_verdicts.csv",
        design=f"{RESULTS}/tables/robustness_design.csv",
        descriptions=[
            f"{RESULTS}/tables/robustness{name}.csv-metadata.json"
            for name in ("", "_indices", "_verdicts", "_design")
        ],
    log:
        f"{RESULTS}/logs/robustness.log",
    benchmark:
        f"{RESULTS}/benchmarks/robustness.tsv"
    threads: 1
    params:
        dpi=DPI,
    script:
        "../scripts/robustness.py"
