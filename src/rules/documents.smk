# What the repository shows of itself: pictures and the reference of the config, both committed. Not part of `all`.
from pathlib import Path

IMAGES = [
    Path(path).name
    for output in [*FIGURES, rules.margins.output]
    for path in output
    if path.endswith(".png") and Path(path).parent == Path(PLOTS)
]
CHART_FIGURES = ["Y4", "safe", "pareto", "explanation", "stiffening"]
PASSAGE_FIGURES = ["sweeps", "long_runs"]
TIP_TURNS = "results/tip_turns"  # of config/tip_turns.yaml, whose rules make it
TIP_TURNS_FIGURES = [
    "fig08_spectrum_soft",
    "fig09_spectrum_critical",
    "fig11_Y4",
    "fig12_f4",
    "fig13_Y6",
    "fig14_f6",
    "fig15_spectrum_theta0",
    "fig16_spectrum_theta015",
]


rule images:
    input:
        [f"{PLOTS}/{name}" for name in IMAGES],
    output:
        [f"docs/images/{name}" for name in IMAGES],
    log:
        f"{RESULTS}/logs/images.log",
    params:
        colours=64,
        few=[f"docs/images/{name}" for name in IMAGES if "history" in name],  # lines
    script:
        "../scripts/images.py"


use rule images as chart_images with:
    input:
        [f"{PLOTS}/chart_{name}.png" for name in CHART_FIGURES],
    output:
        [f"docs/images/chart_{name}.png" for name in CHART_FIGURES],
    log:
        f"{RESULTS}/logs/chart_images.log",
    params:
        colours=20,


use rule images as passage_images with:
    input:
        [f"{PLOTS}/{name}.png" for name in PASSAGE_FIGURES],
    output:
        [f"docs/images/{name}.png" for name in PASSAGE_FIGURES],
    log:
        f"{RESULTS}/logs/passage_images.log",
    params:
        colours=20,


use rule images as robustness_image with:
    input:
        f"{PLOTS}/robustness.png",
    output:
        "docs/images/robustness.png",
    log:
        f"{RESULTS}/logs/robustness_image.log",
    params:
        colours=20,


use rule images as identification_image with:
    input:
        f"{PLOTS}/identification.png",
    output:
        "docs/images/identification.png",
    log:
        f"{RESULTS}/logs/identification_image.log",
    params:
        colours=8,


use rule images as rotor_image with:
    input:
        f"{PLOTS}/rotor.png",
        f"{PLOTS}/rotor_sweeps.png",
    output:
        "docs/images/rotor.png",
        "docs/images/rotor_sweeps.png",
    log:
        f"{RESULTS}/logs/rotor_image.log",
    params:
        colours=64,
        shrink=2,


use rule images as rotor37_images with:
    input:
        [f"{ROTOR37}/figures/{name}.png" for name in ROTOR37_SHOWN],
    output:
        [f"docs/images/rotor37_{name}.png" for name in ROTOR37_SHOWN],
    log:
        f"{RESULTS}/logs/rotor37_images.log",
    params:
        colours=12,


use rule images as rigs_image with:
    input:
        rules.rigs.output.png,
    output:
        "docs/images/rigs.png",
    log:
        f"{RESULTS}/logs/rigs_image.log",
    params:
        colours=12,
        shrink=2,


use rule images as tip_turns_images with:
    input:
        [f"{TIP_TURNS}/figures/{name}.png" for name in TIP_TURNS_FIGURES],
    output:
        [f"docs/images/tip_turns_{name}.png" for name in TIP_TURNS_FIGURES],
    log:
        f"{RESULTS}/logs/tip_turns_images.log",
    params:
        colours=64,
        shrink=2,  # shown in pairs


rule config_reference:
    input:
        schema="config/schema.yaml",
        config="config/config.yaml",
        writing=files_behind("config.reference"),
    output:
        "docs/config.md",
    log:
        f"{RESULTS}/logs/config_reference.log",
    script:
        "../scripts/config_reference.py"


# Tables of the study that pages quote; the targets below have more
QUOTED = ["findings", "margins", "peaks", "divergence", "rom_accuracy", "campbell"]


# Without an output: they render the pages in place, whenever they are asked for.
rule docs_data:
    input:
        [f"{TABLES}/{name}.csv" for name in QUOTED],
    log:
        f"{RESULTS}/logs/docs_data.log",
    script:
        "../scripts/docs_data.py"


use rule docs_data as docs_cost with:
    input:
        rules.cost.output.table,
        rules.cost.output.schedule,
    log:
        f"{RESULTS}/logs/docs_cost.log",


use rule docs_data as docs_friction with:
    input:
        rules.friction.output.table,
    log:
        f"{RESULTS}/logs/docs_friction.log",


use rule docs_data as docs_stress with:
    input:
        rules.stress.output.table,
    log:
        f"{RESULTS}/logs/docs_stress.log",


use rule docs_data as docs_finer_bars with:
    input:
        rules.finer_bars.output.table,
    log:
        f"{RESULTS}/logs/docs_finer_bars.log",


use rule docs_data as docs_rigid_convergence with:
    input:
        rules.rigid_convergence.output.table,
    log:
        f"{RESULTS}/logs/docs_rigid_convergence.log",


use rule docs_data as docs_accuracy with:
    input:
        rules.accuracy.output.table,
    log:
        f"{RESULTS}/logs/docs_accuracy.log",


use rule docs_data as docs_more_nodes with:
    input:
        rules.more_nodes.output.table,
    log:
        f"{RESULTS}/logs/docs_more_nodes.log",


use rule docs_data as docs_sweeps with:
    input:
        rules.sweeps.output.table,
    log:
        f"{RESULTS}/logs/docs_sweeps.log",


use rule docs_data as docs_long_runs with:
    input:
        rules.long_runs.output.table,
    log:
        f"{RESULTS}/logs/docs_long_runs.log",


use rule docs_data as docs_rotor with:
    input:
        rules.rotor_tables.output.table,
        rules.rotor_tables.output.half,
        rules.rotor_patterns.output.drift,
    log:
        f"{RESULTS}/logs/docs_rotor.log",


use rule docs_data as docs_calibration with:
    input:
        rules.calibration.output.table,
        rules.calibration.output.counts,
    log:
        f"{RESULTS}/logs/docs_calibration.log",


# With `--config calibration=config/laws.yaml results=results/laws`, whose rules make these tables; heat likewise
use rule docs_data as docs_laws with:
    input:
        "results/laws/tables/calibration.csv",
        "results/laws/tables/calibration_counts.csv",
    log:
        f"{RESULTS}/logs/docs_laws.log",
    params:
        prefix="laws_",


use rule docs_data as docs_heat with:
    input:
        rules.heat.output.table,
    log:
        f"{RESULTS}/logs/docs_heat.log",


use rule docs_data as docs_heat_calibration with:
    input:
        "results/heat/tables/calibration.csv",
        "results/heat/tables/calibration_counts.csv",
    log:
        f"{RESULTS}/logs/docs_heat_calibration.log",
    params:
        prefix="heat_",


use rule docs_data as docs_chart with:
    input:
        rules.chart_table.output.table,
        rules.chart_ridge.output.summary,
        rules.chart_stiffening.output.table,
        rules.chart_placement.output.summary,
        rules.chart_explanation.output.table,
        rules.chart_agreement.output.table,
    log:
        f"{RESULTS}/logs/docs_chart.log",


use rule docs_data as docs_robustness with:
    input:
        rules.robustness.output.table,
    log:
        f"{RESULTS}/logs/docs_robustness.log",


use rule docs_data as docs_identification with:
    input:
        rules.identify.output.waves,
        rules.identify.output.emulators,
        rules.identify.output.targets,
        rules.identify.output.ranges,
        rules.identify.output.exclusions,
        rules.identify.output.candidates,
        rules.identify.output.counts,
        rules.identify.output.verdicts,
    log:
        f"{RESULTS}/logs/docs_identification.log",


use rule docs_data as docs_rotor37 with:
    input:
        [
            rules.rotor37.output[name]
            for name in [*REFERENCE_TABLES, "history", "independent"]
        ],
    log:
        f"{RESULTS}/logs/docs_rotor37.log",
    params:
        folder="benchmarks/rotor37",


use rule docs_data as docs_rotor37_nlstep with:
    input:
        rules.rotor37_nlstep.output.table,
    log:
        f"{RESULTS}/logs/docs_rotor37_nlstep.log",
    params:
        folder="benchmarks/rotor37",


use rule docs_data as docs_rotor37_nodes with:
    input:
        "results_rotor37/tables/more_nodes.csv",
    log:
        f"{RESULTS}/logs/docs_rotor37_nodes.log",
    params:
        prefix="rotor37_",


# With `--configfile config/fine.yaml`, whose margins have the answers with the finer speeds
use rule docs_data as docs_fine with:
    input:
        f"{TABLES}/margins.csv",
    log:
        f"{RESULTS}/logs/docs_fine.log",
    params:
        prefix="fine_",
        only={"variation": "study"},


# With `--configfile config/longer.yaml`
use rule docs_data as docs_longer with:
    input:
        [f"{TABLES}/{name}.csv" for name in ("findings", "peaks", "divergence")],
    log:
        f"{RESULTS}/logs/docs_longer.log",
    params:
        prefix="longer_",


use rule docs_data as docs_tip_turns with:
    input:
        f"{TIP_TURNS}/tables/findings.csv",
        f"{TIP_TURNS}/tables/peaks.csv",
    log:
        f"{RESULTS}/logs/docs_tip_turns.log",
    params:
        prefix="tip_turns_",


# With `--configfile config/twisted_plate.yaml`
use rule docs_data as docs_twisted_plate with:
    input:
        rules.blade_comparison.output.blades,
        rules.blade_comparison.output.runs,
        f"{TABLES}/peaks.csv",
        f"{TABLES}/divergence.csv",
    log:
        f"{RESULTS}/logs/docs_twisted_plate.log",
    params:
        prefix="twisted_plate_",


rule docs_pages:
    log:
        f"{RESULTS}/logs/docs_pages.log",
    script:
        "../scripts/docs_data.py"
