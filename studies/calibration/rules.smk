# The choices that the paper leaves open, varied (studies/calibration/README.md). Not part of `all`.
from functools import cache


@cache
def calibration_plan():
    """The config of every set; read only when somebody asks for the calibration."""
    from bladerub.extras.calibration.sets import plan

    with bladerub.io.errors.exit_on_error():
        return plan(config)


def calibration_findings(wildcards):
    return [
        f"{RESULTS}/calibration/{name}/tables/findings.csv"
        for name in calibration_plan()
    ]


def calibration_set(wildcards):
    """The choices of one set: a changed one is a reason to run."""
    return calibration_plan()[wildcards.set]


rule calibration:
    input:
        findings=calibration_findings,
        drawing=files_behind("extras.calibration.sets", "plots.verdicts"),
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


rule calibration_set:
    input:
        kernel=rules.compile_kernel.output[0],
        building=rules.blade.input.code,
        given=rules.blade.input.given,
        analysing=files_behind("extras.calibration.sets", "study.findings"),
    output:
        **described(table=f"{RESULTS}/calibration/{{set}}/tables/findings.csv"),
    log:
        f"{RESULTS}/logs/calibration/{{set}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/calibration/{{set}}.tsv"
    resources:
        mem_mb=memory_mb,  # 600 measured
        runtime=minutes(30),  # 5 measured
    params:
        folder=f"{RESULTS}/calibration/{{set}}",
        choices=calibration_set,
    script:
        "scripts/calibration_set.py"
