# The study as a graph of jobs: a blade is built once, it is simulated on many coatings at many speeds, the runs
# are collected, analysed and drawn. `snakemake -j2` makes all of it; config/config.yaml says what.
from snakemake.utils import min_version

import bladerub.io.errors
from bladerub import plugins
from bladerub.io.folders import ROOT
from bladerub.study.grid import coating_cases
from bladerub.study.solver import solver_of
from bladerub.workflow import invocation

min_version("9.0")

# Snakemake keeps no lines of files, which messages name: the config is read here, before it reads it.
# STUDY has it as models, for functions; `config` is plain, as Snakemake has it
with bladerub.io.errors.exit_on_error():
    STUDY, NOTES, LAID_OVER = invocation.read_config(workflow, config)


configfile: "config/config.yaml"


config.clear()
config.update(STUDY.plain())
RESULTS = config["results"]
COATINGS = [case.name for case in coating_cases(STUDY)]


RULES_OF_STUDIES, LEFT_OUT = invocation.rules_of_studies(ROOT)


# Not in the jobs, which are processes that read this file as well
if workflow.is_main_process:
    with bladerub.io.errors.exit_on_error():
        invocation.plan(RESULTS, LAID_OVER, [*NOTES, *LEFT_OUT], solver_of(STUDY).start)
    if workflow.output_settings.dryrun:
        # they take seconds to import
        for forecast in plugins.loaded("FORECASTS").values():
            forecast.announce_at_exit(STUDY, workflow)


onstart:
    with bladerub.io.errors.exit_on_error():
        invocation.start(workflow)
    for forecast in plugins.loaded("FORECASTS").values():
        forecast.announce(STUDY, workflow, workflow.resource_settings.cores, plan_of)


onsuccess:
    invocation.finished(RESULTS)


onerror:
    invocation.stopped()


wildcard_constraints:
    coating="[A-Za-z0-9]+_(E[^_/]+_K[^_/]+_(theta|mu)|rigid_mu)[^_/]+(_xi[^_/]+)?(_h[^_/]+)?(_d[^_/]+)?",
    casing="|".join(config["casings"]),


include: "src/rules/outputs.smk"
include: "src/rules/blade.smk"
include: "src/rules/runs.smk"
include: "src/rules/maps.smk"
include: "src/rules/figures.smk"


# Outputs of rules of studies that `all` makes as well, by rule
ADDED_TO_ALL = {}

for rules_of_study in RULES_OF_STUDIES:

    include: rules_of_study.as_posix()


include: "src/rules/images.smk"


rule all:
    default_target: True
    input:
        rules.blade.output,
        rules.blade_tables.output,
        # the maps need them, but Snakemake replaces no lost one for a map that is there
        expand(rules.coating.output.manifest, coating=COATINGS),
        expand(rules.coating.output.map, coating=COATINGS),
        rules.peaks.output,
        rules.divergence.output,
        FIGURES,
        JUDGED,
        list(ADDED_TO_ALL.values()),
    localrule: True
