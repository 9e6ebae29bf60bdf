# The study repeated with other inputs: calibration, robustness, identification; and on parts of itself: margins. Only
# the last is part of `all`.
from functools import cache, partial

PLANS = {
    "calibration": config["calibration"],
    "robustness": "config/robustness.yaml",
    "identification": "config/identification.yaml",
}
OF_SETS = f"{RESULTS}/identification"
LEFT_TABLES = ["left", "emulators", "ranges", "next_sets", "predictions"]  # of each wave
SUMMED = ["sets", "waves", "emulators", "targets", "ranges", "exclusions", "candidates", "counts", "verdicts"]


@cache
def variations_plan(kind):
    """The plan of that kind; read and checked only when somebody asks for it."""
    from bladerub.extras.variations.job import check
    from bladerub.extras.variations.plan import read

    with bladerub.io.errors.exit_on_error():
        key = kind if kind in config else None
        plan = read(kind, PLANS[kind], key)
        if workflow.is_main_process:
            check(STUDY, plan)
    return plan


identification_plan = partial(variations_plan, "identification")


# All but results that determines which sets are drawn: a changed one is a reason to run
SAMPLING = {
    "plan": PLANS["identification"],
    "sampling": lambda wildcards: identification_plan().sampling(STUDY),
}


@cache
def determining_sets(kind, job):
    """All of plan and study that determines what the sets of a job show: a changed one is a reason to run."""
    from bladerub.extras.variations.job import determinants

    plan = variations_plan(kind)
    return determinants(STUDY, plan, plan.jobs()[job])


def of_jobs(kind, file, folders=""):
    """What the jobs of a plan, or those whose name begins with one of the folders, write under that name."""
    jobs = variations_plan(kind).jobs()
    return [f"{RESULTS}/{kind}/{job}/{file}" for job in jobs if job.startswith(folders)]


def wave_folders(wildcards):
    """Folders of the waves up to that of a job, of all if it is of none."""
    last = int(wildcards.get("wave", len(identification_plan().waves)))
    return tuple(f"wave{wave}/" for wave in range(1, last + 1))


def of_waves(file):
    """What there is of these waves under that name."""
    return lambda wildcards: [f"{OF_SETS}/{folder}{file}" for folder in wave_folders(wildcards)]


def of_sets(file):
    """What all jobs of these waves write under that name."""
    return lambda wildcards: of_jobs("identification", file, wave_folders(wildcards))


def drawn_sets(wildcards):
    """The table with the sets of a job, of an identification."""
    if wildcards.kind != "identification":
        return []
    folder = wildcards.job.partition("/")[0]
    name = "candidates" if folder == "candidates" else "sets"
    return f"{OF_SETS}/{folder}/{name}.csv"


def variation_minutes(wildcards, attempt):
    """As `coating_minutes`, over the coatings and elements of the small studies, and a minute for each blade."""
    from bladerub.extras.variations.job import minutes

    plan = variations_plan(wildcards.kind)
    return attempt * minutes(STUDY, plan, plan.jobs()[wildcards.job])


# The one kind of job; the blades are beside it, undeclared, under the digest of what they are built from
rule variation:
    input:
        sets=drawn_sets,
        kernel=rules.compile_kernel.output[0],
        building=rules.blade.input.code,
        given=rules.blade.input.given,
        simulating=files_behind("extras.variations.job", "study.findings"),
    output:
        **described(
            **{name: f"{RESULTS}/{{kind}}/{{job}}/{name}.csv" for name in ("verdicts", "quantities", "cost")}
        ),
    log:
        f"{RESULTS}/logs/{{kind}}/{{job}}.log",
    wildcard_constraints:
        kind="|".join(PLANS),
        job="[A-Za-z0-9_.]+(/[A-Za-z0-9_]+)?",
    resources:
        runtime=variation_minutes,
    params:
        plan=lambda wildcards: PLANS[wildcards.kind],
        determining=lambda wildcards: determining_sets(wildcards.kind, wildcards.job),
        blades=f"{RESULTS}/{{kind}}/blades",
        # only of a calibration are runs and maps kept
        folder=lambda wildcards: (
            f"{RESULTS}/calibration/{wildcards.job}" if wildcards.kind == "calibration" else None
        ),
    script:
        "scripts/variation.py"


rule calibration:
    input:
        verdicts=lambda wildcards: of_jobs("calibration", "verdicts.csv"),
        drawing=files_behind("extras.variations.verdicts", "plots.style"),
    output:
        **described(
            table=f"{TABLES}/calibration.csv",
            counts=f"{TABLES}/calibration_counts.csv",
        ),
        png=f"{PLOTS}/calibration.png",
        pdf=f"{PLOTS}/calibration.pdf",
    log:
        f"{RESULTS}/logs/calibration.log",
    params:
        dpi=DPI,
    script:
        "scripts/calibration.py"


rule robustness:
    input:
        verdicts=lambda wildcards: of_jobs("robustness", "verdicts.csv"),
        cost=lambda wildcards: of_jobs("robustness", "cost.csv"),
        plan=PLANS["robustness"],
        analysing=files_behind("study.findings", "extras.variations.robustness"),
        drawing=files_behind("extras.variations.figures", "plots.style"),
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
    params:
        dpi=DPI,
    script:
        "scripts/robustness.py"


rule identification_wave:
    input:
        next_sets=lambda wildcards: (
            [] if wildcards.wave == "1" else f"{OF_SETS}/wave{int(wildcards.wave) - 1}/next_sets.csv"
        ),
        drawing=files_behind("extras.variations.waves"),
    output:
        **described(sets=f"{OF_SETS}/wave{{wave}}/sets.csv"),
    log:
        f"{RESULTS}/logs/identification_wave/{{wave}}.log",
    wildcard_constraints:
        wave="[0-9]+",
    resources:
        runtime=minutes(5),
    params:
        **SAMPLING,
        drawn=lambda wildcards: identification_plan().size(int(wildcards.wave)),
    script:
        "scripts/identification_wave.py"


rule identification_left:
    input:
        sets=of_waves("sets.csv"),
        quantities=of_sets("quantities.csv"),
        drawing=files_behind("extras.variations.waves"),
    output:
        **described(**{name: f"{OF_SETS}/wave{{wave}}/{name}.csv" for name in LEFT_TABLES}),
    log:
        f"{RESULTS}/logs/identification_left/{{wave}}.log",
    wildcard_constraints:
        wave="[0-9]+",
    resources:
        runtime=minutes(120),
    params:
        **SAMPLING,
        remaining=lambda wildcards: identification_plan().remaining,
    script:
        "scripts/identification_left.py"


rule identification_candidates:
    input:
        sets=of_waves("sets.csv"),
        quantities=of_sets("quantities.csv"),
        verdicts=of_sets("verdicts.csv"),
        choosing=files_behind("extras.variations.waves"),
    output:
        **described(candidates=f"{OF_SETS}/candidates/candidates.csv"),
    log:
        f"{RESULTS}/logs/identification_candidates.log",
    resources:
        runtime=minutes(5),
    params:
        **SAMPLING,
        wanted=lambda wildcards: identification_plan().candidates.pairs,
        shift=lambda wildcards: identification_plan().candidates.shift,
    script:
        "scripts/identification_candidates.py"


rule identify:
    input:
        **{name: of_waves(f"{name}.csv") for name in ["sets", *LEFT_TABLES]},
        quantities=of_sets("quantities.csv"),
        verdicts=of_sets("verdicts.csv"),
        candidates=rules.identification_candidates.output.candidates,
        judged=lambda wildcards: of_jobs("identification", "verdicts.csv", "candidates/"),
        plan=PLANS["identification"],
        summing=files_behind("extras.variations.identification"),
        drawing=files_behind("extras.variations.figures", "plots.style"),
    output:
        **drawn("identification", "Claims"),
        **described(**{name: f"{TABLES}/identification_{name}.csv" for name in SUMMED}),
    log:
        f"{RESULTS}/logs/identify.log",
    resources:
        runtime=minutes(10),
    params:
        dpi=DPI,
    script:
        "scripts/identify.py"


# How far the analysis itself decides the verdicts
rule margins:
    input:
        maps=expand(rules.coating.output.map, coating=COATINGS),
        rom_accuracy=rules.blade_tables.output.rom_accuracy,
        analysing=files_behind("extras.variations.verdicts", "study.findings"),
        drawing=files_behind("extras.variations.verdicts", "plots.style"),
    output:
        **drawn("margins", "Claims"),
        **described(table=shown(f"{TABLES}/margins.csv", "margins_table", "Claims")),
    log:
        f"{RESULTS}/logs/margins.log",
    benchmark:
        f"{RESULTS}/benchmarks/margins.tsv"
    group:
        "drawing"
    params:
        analysis=config["analysis"] | {"peaks": PEAKS},
        speeds=config["speeds"],
        dpi=DPI,
    script:
        "scripts/margins.py"


# The paper speaks of its own blade and coatings: others are not judged by its claims
if "source" not in config["blade"] and not all(case.variant for case in coating_cases(STUDY)):
    ADDED_TO_ALL["margins"] = rules.margins.output

PICTURES["margins_image"] = {"docs/images/margins.png": Picture(f"{PLOTS}/margins.png", 48)}
PICTURES |= {
    f"{name}_image": {f"studies/variations/images/{name}.png": Picture(f"{PLOTS}/{name}.png", colours)}
    for name, colours in (("robustness", 20), ("identification", 8))
}
