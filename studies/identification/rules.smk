# Which values of what the paper does not print agree with it (studies/identification/README.md). Not part of `all`.
from functools import cache

IDENTIFICATION = "config/identification.yaml"
OF_SETS = f"{RESULTS}/identification"
SIMULATING_SETS = files_behind(
    "extras.identification.sample", "study.findings", "blade.build"
)


@cache
def identification_plan():
    """The plan; read and checked only when somebody asks for the identification."""
    from bladerub.extras.identification.plan import read_plan
    from bladerub.extras.identification.sample import check

    with bladerub.io.errors.exit_on_error():
        plan = read_plan(IDENTIFICATION)
        if workflow.is_main_process:
            check(config, plan)
    return plan


def up_to(last=None):
    """Numbers of the waves up to one, of all of the plan without it."""
    return range(1, (last or len(identification_plan().waves)) + 1)


def drawn_sets(last=None):
    """The sets of these waves."""
    return [f"{OF_SETS}/wave{wave}/sets.csv" for wave in up_to(last)]


def of_sets(file, last=None):
    """What all jobs of these waves write under that name."""
    return [
        f"{OF_SETS}/wave{wave}/{job}/{file}"
        for wave in up_to(last)
        for job in range(len(identification_plan().batches(wave)))
    ]


def after_waves(file):
    """What is found after each wave under that name."""
    return [f"{OF_SETS}/wave{wave}/{file}" for wave in up_to()]


def candidate_numbers():
    """Candidate and neighbour of each finer study; candidate 0 has the study's own values."""
    wanted = identification_plan().candidates
    return [
        (candidate, neighbour)
        for candidate in range(wanted.number + 1)
        for neighbour in range(wanted.neighbours + 1)
    ]


def determining_sets(wildcards):
    """All of the plan and the study that determines what a set shows: a changed one is a reason to run."""
    from bladerub.extras.identification.sample import determinants

    return determinants(config, identification_plan())


def set_minutes(n_sets):
    """Time to ask a cluster for: at least three times what was measured."""
    return lambda wildcards, attempt: attempt * math.ceil(4 * n_sets)


def identification_kernels(wildcards):
    """The machine code that the sets need: jobs that start together would all compile it."""
    factors = identification_plan().factors
    turns = any("contact.tip_turns" in factor.ranges for factor in factors)
    both = [rules.compile_kernel.output[0], rules.identification_kernel.output[0]]
    return both if turns else both[:1]


use rule compile_kernel as identification_kernel with:
    output:
        f"{OF_SETS}/kernel.json",
    log:
        f"{RESULTS}/logs/identification_kernel.log",
    benchmark:
        f"{RESULTS}/benchmarks/identification_kernel.tsv"
    params:
        tip_turns=True,


rule identification_wave:
    input:
        next_sets=lambda wildcards: (
            []
            if wildcards.wave == "1"
            else f"{OF_SETS}/wave{int(wildcards.wave) - 1}/next_sets.csv"
        ),
    output:
        **described(sets=f"{OF_SETS}/wave{{wave}}/sets.csv"),
    log:
        f"{RESULTS}/logs/identification_wave/{{wave}}.log",
    wildcard_constraints:
        wave="[0-9]+",
    resources:
        mem_mb=memory_mb,
        runtime=minutes(5),
    params:
        plan=IDENTIFICATION,
        determining=determining_sets,
        drawn=lambda wildcards: identification_plan().size(int(wildcards.wave)),
    script:
        "scripts/identification_wave.py"


rule identification_batch:
    input:
        sets=f"{OF_SETS}/wave{{wave}}/sets.csv",
        kernel=identification_kernels,
        simulating=SIMULATING_SETS,
    output:
        **described(
            quantities=f"{OF_SETS}/wave{{wave}}/{{batch}}/quantities.csv",
            verdicts=f"{OF_SETS}/wave{{wave}}/{{batch}}/verdicts.csv",
            cost=f"{OF_SETS}/wave{{wave}}/{{batch}}/cost.csv",
        ),
    log:
        f"{RESULTS}/logs/identification_batch/{{wave}}_{{batch}}.log",
    wildcard_constraints:
        wave="[0-9]+",
        batch="[0-9]+",
    resources:
        mem_mb=memory_mb,
        runtime=set_minutes(4),
    params:
        plan=IDENTIFICATION,
        determining=determining_sets,
    script:
        "scripts/identification_batch.py"


rule identification_left:
    input:
        sets=lambda wildcards: drawn_sets(int(wildcards.wave)),
        quantities=lambda wildcards: of_sets("quantities.csv", int(wildcards.wave)),
        drawing=files_behind("extras.identification.waves"),
    output:
        **described(
            left=f"{OF_SETS}/wave{{wave}}/left.csv",
            emulators=f"{OF_SETS}/wave{{wave}}/emulators.csv",
            ranges=f"{OF_SETS}/wave{{wave}}/ranges.csv",
            next_sets=f"{OF_SETS}/wave{{wave}}/next_sets.csv",
            predictions=f"{OF_SETS}/wave{{wave}}/predictions.csv",
        ),
    log:
        f"{RESULTS}/logs/identification_left/{{wave}}.log",
    wildcard_constraints:
        wave="[0-9]+",
    resources:
        mem_mb=memory_mb,
        runtime=minutes(120),
    params:
        plan=IDENTIFICATION,
        remaining=lambda wildcards: identification_plan().remaining,
    script:
        "scripts/identification_left.py"


rule identification_candidates:
    input:
        sets=lambda wildcards: drawn_sets(),
        quantities=lambda wildcards: of_sets("quantities.csv"),
        verdicts=lambda wildcards: of_sets("verdicts.csv"),
        choosing=files_behind("extras.identification.candidates"),
    output:
        **described(candidates=f"{OF_SETS}/candidates/candidates.csv"),
    log:
        f"{RESULTS}/logs/identification_candidates.log",
    resources:
        mem_mb=memory_mb,
        runtime=minutes(5),
    params:
        plan=IDENTIFICATION,
        wanted=lambda wildcards: candidate_numbers(),
        shift=lambda wildcards: identification_plan().candidates.shift,
    script:
        "scripts/identification_candidates.py"


rule identification_candidate:
    input:
        candidates=rules.identification_candidates.output.candidates,
        kernel=identification_kernels,
        simulating=SIMULATING_SETS,
    output:
        **described(
            verdicts=f"{OF_SETS}/candidates/{{candidate}}_{{neighbour}}/verdicts.csv"
        ),
    log:
        f"{RESULTS}/logs/identification_candidate/{{candidate}}_{{neighbour}}.log",
    wildcard_constraints:
        candidate="[0-9]+",
        neighbour="[0-9]+",
    resources:
        mem_mb=memory_mb,
        runtime=minutes(40),
    params:
        plan=IDENTIFICATION,
        determining=determining_sets,
        study=lambda wildcards: identification_plan().candidates.study.plain(),
    script:
        "scripts/identification_candidate.py"


rule identify:
    input:
        sets=lambda wildcards: drawn_sets(),
        quantities=lambda wildcards: of_sets("quantities.csv"),
        verdicts=lambda wildcards: of_sets("verdicts.csv"),
        left=lambda wildcards: after_waves("left.csv"),
        emulators=lambda wildcards: after_waves("emulators.csv"),
        ranges=lambda wildcards: after_waves("ranges.csv"),
        next_sets=lambda wildcards: after_waves("next_sets.csv"),
        predictions=lambda wildcards: after_waves("predictions.csv"),
        candidates=rules.identification_candidates.output.candidates,
        judged=lambda wildcards: [
            f"{OF_SETS}/candidates/{candidate}_{neighbour}/verdicts.csv"
            for candidate, neighbour in candidate_numbers()
        ],
        plan=IDENTIFICATION,
        summing=files_behind(
            "extras.identification.summary", "extras.identification.candidates"
        ),
        drawing=files_behind("extras.plots.identification", "plots.style"),
    output:
        **drawn("identification", "Claims"),
        **described(
            **{
                name: f"{TABLES}/identification_{name}.csv"
                for name in (
                    "sets",
                    "waves",
                    "emulators",
                    "targets",
                    "ranges",
                    "exclusions",
                    "candidates",
                    "counts",
                    "verdicts",
                )
            }
        ),
    log:
        f"{RESULTS}/logs/identify.log",
    resources:
        mem_mb=memory_mb,
        runtime=minutes(10),
    params:
        dpi=DPI,
    script:
        "scripts/identify.py"


use rule images as identification_image with:
    input:
        f"{PLOTS}/identification.png",
    output:
        "studies/identification/images/identification.png",
    log:
        f"{RESULTS}/logs/identification_image.log",
    params:
        colours=8,
