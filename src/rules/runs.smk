# Stage 2: the runs. One job is one coating at all its speeds, with its map; one run is one file.
import math
from dataclasses import asdict
from functools import cache

from bladerub.blade.model import n_interface
from bladerub.contact.laws import law_digest, solver_digest
from bladerub.study.grid import case_from_name, element_law
from bladerub.study.plan import coating_plan, growth_key


@cache
def plan_of(coating):
    return coating_plan(STUDY, case_from_name(STUDY, coating))


def minutes_for(runs, attempt):
    """The time to ask a cluster for: a minute to start, and three times what the revolutions took."""
    revolutions = sum(run.spec.revolutions * run.n_blades for run in runs)
    return attempt * math.ceil((60 + 0.03 * revolutions) / 60)


@cache
def schedules():
    """What divides the cores among the jobs; without it all have one, and none comes first."""
    return [schedule_of(STUDY) for schedule_of in plugins.loaded("SCHEDULES").values()]


def threads_of(rule, coating):
    cores = workflow.resource_settings.cores
    return max((schedule.threads(rule, coating, cores) for schedule in schedules()), default=1)


def coating_priority(wildcards):
    return max((schedule.priority(wildcards.coating) for schedule in schedules()), default=0)


def coating_minutes(wildcards, attempt):
    return minutes_for(plan_of(wildcards.coating).runs, attempt)


rule compile_kernel:
    # before any run, because jobs that start together on a cold cache would all compile
    output:
        f"{RESULTS}/runs/kernel.json",
    log:
        f"{RESULTS}/logs/compile_kernel.log",
    benchmark:
        f"{RESULTS}/benchmarks/compile_kernel.tsv"
    resources:
        runtime=minutes(5),
    params:
        solver=solver_digest(),
        tip_turns=config["contact"].get("tip_turns", False),
        n_nodes=n_interface(STUDY),
        law=asdict(element_law(STUDY)),
        law_module=law_digest(element_law(STUDY)),
    script:
        script_of("compile_kernel")


# What every simulation takes
SIMULATING = {"blade": rules.blade.output.reduced_model, "kernel": rules.compile_kernel.output[0]}
MANIFEST = f"{RESULTS}/runs/{{coating}}/manifest.tsv"
MAP = f"{RESULTS}/maps/{{coating}}.h5"


rule coating:
    # The runs are next to the manifest, undeclared: Snakemake deletes what a failed job declares, and
    # finished runs must survive. The key inside the file of a run shows whether it is current.
    input:
        replaces(workflow, MANIFEST),
        replaces(workflow, MAP, damage),
        **SIMULATING,
        analysing=files_behind("study.maps"),
    output:
        manifest=MANIFEST,
        map=MAP,
    log:
        f"{RESULTS}/logs/coating/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/coating/{{coating}}.tsv"
    priority: coating_priority
    group:
        "rubs"
    threads: lambda wildcards: threads_of("coating", wildcards.coating)
    resources:
        runtime=coating_minutes,
    params:
        folder=subpath(output.manifest, parent=True),
        lobe_prominence=config["analysis"]["lobe_prominence"],
        plan=lambda wildcards: plan_of(wildcards.coating),  # no reason to run, being an object
        # all that determines the runs but the blade: a changed one is a reason to run
        planned=lambda wildcards: {run.file: run.determinants for run in plan_of(wildcards.coating).runs},
        confirmed=growth_key(STUDY),
    script:
        "../scripts/coating.py"
