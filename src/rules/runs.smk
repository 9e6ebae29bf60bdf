# Stage 2: the rubs. One job is one coating at all its speeds; one run is one file.
import math

from bladerub.study.confirmation import determinants
from bladerub.study import plan
from bladerub.study.grid import case_from_name, speeds
from bladerub.io.sources import solver_digest


def planned_runs(wildcards):
    """All that determines the runs of a coating but the blade: a changed one is a reason to run."""
    case = case_from_name(config, wildcards.coating)
    runs = plan.planned_runs(config, case, "", "the blade is an input")
    return {run.path.stem: run.key for run in runs}


def coating_minutes(wildcards, attempt):
    """The time to ask a cluster for: a minute to start, and three times what the revolutions took."""
    revolutions = len(speeds(config)) * config["solver"]["revolutions"]
    return attempt * math.ceil((60 + 0.03 * revolutions) / 60)


rule compile_kernel:
    # before any rub, because jobs that start together on a cold cache would all compile
    output:
        f"{RESULTS}/runs/kernel.json",
    log:
        f"{RESULTS}/logs/compile_kernel.log",
    benchmark:
        f"{RESULTS}/benchmarks/compile_kernel.tsv"
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2000 * attempt,
        runtime=lambda wildcards, attempt: 5 * attempt,
    params:
        solver=solver_digest(),
    script:
        "../scripts/compile_kernel.py"


rule coating:
    # The runs lie beside the manifest, undeclared: Snakemake deletes what a failed job declares, and
    # finished runs must survive. Whether a run is current is told by the key inside its file.
    input:
        blade=f"{RESULTS}/blade/reduced_model.h5",
        kernel=rules.compile_kernel.output[0],
    output:
        f"{RESULTS}/runs/{{coating}}/manifest.tsv",
    log:
        f"{RESULTS}/logs/coating/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/coating/{{coating}}.tsv"
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: 2000 * attempt,  # 240 measured, beside two Pythons of Snakemake
        runtime=coating_minutes,
    params:
        folder=subpath(output[0], parent=True),
        planned=planned_runs,
        confirmed=determinants(config["analysis"]["divergence"]),
    script:
        "../scripts/coating.py"
