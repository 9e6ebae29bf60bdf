# How much decides at the peaks of some coatings: the width of the coating's bars, the number of interface nodes; on
# the rigid casing the modes, the step and the law of impact. How accurate runs are, and what they cost. Not in `all`.

# The peaks again: with what, and minutes to ask a cluster for
REPEATED = {
    "finer_bars": ("extras.verification.refinement", 5),
    "more_nodes": ("extras.verification.refinement", 10),
    "rigid_convergence": ("extras.verification.rigid_casing", 15),
}
for repeated, (repetition, first_minutes) in REPEATED.items():

    rule:
        name:
            repeated
        input:
            blade=rules.blade.output.reduced_model,
            kernel=rules.compile_kernel.output[0],
            peaks=rules.peaks.output[0],
            analysing=files_behind(repetition),
        output:
            **described(table=f"{TABLES}/{repeated}.csv"),
        log:
            f"{RESULTS}/logs/{repeated}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{repeated}.tsv"
        group:
            "drawing"
        resources:
            mem_mb=memory_mb,
            runtime=minutes(first_minutes),
        script:
            "scripts/repeated_peaks.py"


# How accurate the study's runs are: a table of what `bladerub verify` measures
rule accuracy:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        maps=expand(rules.coating.output.map, coating=COATINGS),
        analysing=files_behind("extras.verification.accuracy"),
    output:
        **described(table=f"{TABLES}/accuracy.csv"),
    log:
        f"{RESULTS}/logs/accuracy.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy.tsv"
    resources:
        runtime=minutes(30),
    params:
        peaks=PEAKS,
    script:
        "scripts/accuracy.py"


# What a run costs at several tolerances of its step, and what its error is then
rule steps:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        analysing=files_behind("extras.verification.steps"),
        drawing=files_behind("extras.plots.steps"),
    output:
        **described(table=f"{TABLES}/steps.csv"),
        png=f"{PLOTS}/steps.png",
        pdf=f"{PLOTS}/steps.pdf",
    log:
        f"{RESULTS}/logs/steps.log",
    benchmark:
        f"{RESULTS}/benchmarks/steps.tsv"
    resources:
        runtime=minutes(20),
    params:
        dpi=DPI,
        simulated={
            key: config[key]
            for key in (
                "contact",
                "casings",
                "coatings",
                "speeds",
                "solver",
                "analysis",
            )
        },
    script:
        "scripts/steps.py"


PICTURES["steps_image"] = {"studies/convergence/images/steps.png": Picture(rules.steps.output.png, 24)}
