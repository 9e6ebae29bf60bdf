# A dense chart of coatings at speeds that the search for its peaks chooses (studies/chart/README.md). Not part of `all`.
import sys
from functools import cache, partial

from bladerub.extras.chart.plan import check, columns, in_words
from bladerub.extras.chart.point import PointRow, chart_orders
from bladerub.extras.cores import threads_for
from bladerub.study.grid import modulus_unit

CHART_PEAKS = config["analysis"]["peaks"] | {"orders": chart_orders(STUDY)}
PEAK_CAPTIONS = {f"{name}{order}": f"chart_{name}k" for order in CHART_PEAKS["orders"] for name in "Yf"}
CHARTED = [*PEAK_CAPTIONS, "peak", "worn_volume", "divergent_share"]
CHART_FIGURES = ["safe", "pareto", "explanation", "stiffening"]
CHART_TABLES = ["pareto", "choice", "ridge", "ridge_summary", "explanation", "stiffening"]


@cache
def chart_columns():
    """The points of every column; checked, and told of, only when somebody asks for the chart."""
    with bladerub.io.errors.exit_on_error():
        check(STUDY)
        if workflow.is_main_process:
            print(f"bladerub: {in_words(STUDY)}", file=sys.stderr)
    return columns(STUDY)


def chart_manifests(wildcards):
    return [f"{RESULTS}/chart/columns/{column}.tsv" for column in chart_columns()]


def planned_points(wildcards):
    """All that determines the points of a column but the blade: a changed one is a reason to run."""
    from bladerub.extras.chart.column import plan_column  # imports the solver

    return plan_column(STUDY, chart_columns()[wildcards.column])


COLUMN_MANIFEST = f"{RESULTS}/chart/columns/{{column}}.tsv"


rule chart_column:
    # The points have a folder next to that of the manifests, undeclared as the runs of a coating are.
    input:
        replaces(workflow, COLUMN_MANIFEST, partial(loss, kind=PointRow)),
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
    output:
        COLUMN_MANIFEST,
    log:
        f"{RESULTS}/logs/chart_column/{{column}}.log",
    wildcard_constraints:
        column="[A-Za-z0-9]+_E[^_/]+_theta[^_/]+",
    threads: lambda wildcards: threads_for(1, len(chart_columns()), workflow.resource_settings.cores)
    resources:
        runtime=lambda wildcards, attempt: attempt * (2 + len(config["chart"]["K"])),  # a tenth of it measured
    params:
        plan=planned_points,
    script:
        "scripts/chart_column.py"


rule chart_stress:
    # only where the config has a fatigue limit
    input:
        manifests=chart_manifests,
        blade=rules.blade.output.reduced_model,
        mesh=rules.blade.output.mesh,
        kernel=rules.compile_kernel.output[0],
        analysing=files_behind("extras.chart.table", "extras.stress.run"),
    output:
        **described(table=f"{TABLES}/chart_stress.csv"),
    log:
        f"{RESULTS}/logs/chart_stress.log",
    resources:
        runtime=minutes(60),
    params:
        peaks=CHART_PEAKS,
    script:
        "scripts/chart_stress.py"


rule chart:
    # tables and figures in one job, because to start it takes longer than to draw one
    input:
        manifests=chart_manifests,
        stress=rules.chart_stress.output[:1] if "fatigue" in config["chart"]["limits"] else [],
        blade=rules.blade.output.reduced_model,
        analysing=files_behind("extras.chart.table", "extras.chart.stiffening"),
        drawing=files_behind("extras.plots.chart_moduli", "extras.plots.chart_peaks", "plots.titles"),
    output:
        **{
            f"chart_{name}_png": shown(
                f"{PLOTS}/chart_{name}.png",
                PEAK_CAPTIONS.get(name, f"chart_{name}"),
                "8. Choice of a coating",
                title=f"Chart: {name}" if name in PEAK_CAPTIONS else None,
            )
            for name in [*CHARTED, *CHART_FIGURES]
        },
        **{f"chart_{name}_pdf": f"{PLOTS}/chart_{name}.pdf" for name in [*CHARTED, *CHART_FIGURES]},
        **described(
            table=f"{TABLES}/chart.csv",
            **{name: f"{TABLES}/chart_{name}.csv" for name in CHART_TABLES},
        ),
    log:
        f"{RESULTS}/logs/chart.log",
    resources:
        runtime=minutes(5),
    params:
        dpi=DPI,
        quantities=CHARTED,
        modulus_unit=modulus_unit(STUDY),
        limits=config["chart"]["limits"],
        peaks=CHART_PEAKS,
    script:
        "scripts/chart.py"


rule chart_placement:
    # how well the search does, from the study alone: `snakemake results/tables/chart_placement.csv`
    input:
        # of coatings of the study that could be points of the chart
        maps=[
            map_of(case)
            for case in coating_cases(STUDY)
            if not (case.is_rigid or case.variant)
            and case.casing == config["chart"]["casing"]
            and case.theta in config["chart"]["theta"]
        ],
        analysing=files_behind("extras.chart.table"),
    output:
        **described(
            table=f"{TABLES}/chart_placement.csv",
            summary=f"{TABLES}/chart_placement_summary.csv",
        ),
    log:
        f"{RESULTS}/logs/chart_placement.log",
    params:
        peaks=CHART_PEAKS,
        speeds=config["chart"]["speeds"],
    script:
        "scripts/chart_placement.py"


rule chart_agreement:
    # needs both the chart and the study: `snakemake results/tables/chart_agreement.csv`
    input:
        chart=rules.chart.output.table,
        placement=rules.chart_placement.output[0],
        analysing=files_behind("extras.chart.table"),
    output:
        **described(table=f"{TABLES}/chart_agreement.csv"),
    log:
        f"{RESULTS}/logs/chart_agreement.log",
    script:
        "scripts/chart_agreement.py"


PICTURES["chart_images"] = {
    f"studies/chart/images/chart_{name}.png": Picture(f"{PLOTS}/chart_{name}.png", 20)
    for name in ["Y4", *CHART_FIGURES]
}
