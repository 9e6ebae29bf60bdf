# How far the claims depend on what the paper leaves open (studies/robustness/README.md). Not part of `all`.
from functools import cache

ROBUSTNESS = "config/robustness.yaml"
OF_SAMPLES = f"{RESULTS}/robustness"


@cache
def robustness_plan():
    """The plan; read and checked only when somebody asks for the robustness."""
    from bladerub.extras.robustness.design import check
    from bladerub.extras.robustness.plan import read_plan

    with bladerub.io.errors.exit_on_error():
        plan = read_plan(ROBUSTNESS)
        if workflow.is_main_process:
            check(config, plan)
    return plan


@cache
def robustness_batch(part, batch):
    """The config of each sample of one job by its number."""
    from bladerub.extras.robustness import design

    plan = robustness_plan()
    with bladerub.io.errors.exit_on_error():
        return design.batch(config, plan, plan.parts[part], batch)


def robustness_batches():
    """Part and name of every job."""
    from bladerub.extras.robustness.plan import REFERENCE_BATCH

    return [
        (part.name, batch)
        for part in robustness_plan().parts.values()
        for batch in (REFERENCE_BATCH, *map(str, range(len(part.batches()))))
    ]


@cache
def robustness_blades():
    """The config of a sample that has it, for each of the blades by name."""
    from bladerub.extras.robustness.design import blade_name

    return {
        blade_name(sample): sample
        for part, batch in robustness_batches()
        for sample in robustness_batch(part, batch).values()
    }


def of_robustness_blades(file):
    """That file of the blade of every sample of a job."""

    def paths(wildcards):
        from bladerub.extras.robustness.design import blade_name

        samples = robustness_batch(wildcards.part, wildcards.batch).values()
        return [f"{OF_SAMPLES}/blades/{blade_name(each)}/{file}" for each in samples]

    return paths


def of_robustness_batches(file):
    """What all jobs write under that name."""

    def paths(wildcards):
        return [
            f"{OF_SAMPLES}/{part}/{batch}/{file}"
            for part, batch in robustness_batches()
        ]

    return paths


def planned_samples(wildcards):
    """All that determines the findings of the samples of a job but the blades: a changed one is a reason to run."""
    from bladerub.extras.robustness.design import sample_digest

    samples = robustness_batch(wildcards.part, wildcards.batch)
    return {number: sample_digest(sample) for number, sample in samples.items()}


def robustness_minutes(wildcards, attempt):
    """As `coating_minutes`, over the coatings and elements of the samples."""
    revolutions = sum(
        len(coating_cases(sample))
        * len(speeds(sample))
        * sample["solver"]["revolutions"]
        * sample["contact"]["elements"]
        / config["contact"]["elements"]
        for sample in robustness_batch(wildcards.part, wildcards.batch).values()
    )
    return attempt * math.ceil((60 + 0.03 * revolutions) / 60)


use rule blade as robustness_blade with:
    output:
        **described(rom_accuracy=f"{OF_SAMPLES}/blades/{{blade}}/rom_accuracy.csv"),
        reduced_model=f"{OF_SAMPLES}/blades/{{blade}}/reduced_model.h5",
        mesh=f"{OF_SAMPLES}/blades/{{blade}}/mesh.h5",
    log:
        f"{RESULTS}/logs/robustness_blade/{{blade}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/robustness_blade/{{blade}}.tsv"
    params:
        blade=lambda wildcards: robustness_blades()[wildcards.blade]["blade"],
        reduction=lambda wildcards: robustness_blades()[wildcards.blade]["reduction"],


rule robustness_batch:
    input:
        models=of_robustness_blades("reduced_model.h5"),
        accuracies=of_robustness_blades("rom_accuracy.csv"),
        kernel=rules.compile_kernel.output[0],
        analysing=files_behind("extras.robustness.sample", "study.findings"),
    output:
        **described(
            verdicts=f"{OF_SAMPLES}/{{part}}/{{batch}}/verdicts.csv",
            cost=f"{OF_SAMPLES}/{{part}}/{{batch}}/cost.csv",
        ),
    log:
        f"{RESULTS}/logs/robustness_batch/{{part}}_{{batch}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/robustness_batch/{{part}}_{{batch}}.tsv"
    wildcard_constraints:
        part="[A-Za-z][A-Za-z0-9_]*",
        batch="[0-9]+|reference",
    resources:
        mem_mb=memory_mb,
        runtime=robustness_minutes,
    params:
        plan=ROBUSTNESS,
        planned=planned_samples,
        claims=lambda wildcards: robustness_plan().parts[wildcards.part].claims,
    script:
        "scripts/robustness_batch.py"


rule robustness:
    input:
        verdicts=of_robustness_batches("verdicts.csv"),
        cost=of_robustness_batches("cost.csv"),
        plan=ROBUSTNESS,
        analysing=files_behind(
            "study.findings",
            "extras.robustness.plan",
            "extras.robustness.sensitivity",
            "extras.robustness.summary",
        ),
        drawing=files_behind("extras.plots.robustness", "plots.style"),
    output:
        **drawn("robustness", "Claims"),
        **described(
            table=shown(f"{TABLES}/robustness.csv", "robustness_table", "Claims"),
            indices=f"{TABLES}/robustness_indices.csv",
            verdicts=f"{TABLES}/robustness_verdicts.csv",
            design=f"{TABLES}/robustness_design.csv",
        ),
    log:
        f"{RESULTS}/logs/robustness.log",
    benchmark:
        f"{RESULTS}/benchmarks/robustness.tsv"
    params:
        dpi=DPI,
    script:
        "scripts/robustness.py"


use rule images as robustness_image with:
    input:
        f"{PLOTS}/robustness.png",
    output:
        "studies/robustness/images/robustness.png",
    log:
        f"{RESULTS}/logs/robustness_image.log",
    params:
        colours=20,
