# A dense chart of coatings at speeds that the search for its peaks chooses (studies/chart/README.md). Not part of `all`.
import sys
from functools import cache, partial

from bladerub.extras.chart.grid import chart_orders, check
from bladerub.extras.chart.plan import columns, in_words
from bladerub.extras.chart.point import PointRow
from bladerub.study.grid import modulus_unit

CHART_ORDERS = chart_orders(STUDY)
PEAK_CAPTIONS = {f"{name}{order}": f"chart_{name}k" for order in CHART_ORDERS for name in "Yf"}
CHARTED = [*PEAK_CAPTIONS, "peak", "worn_volume", "divergent_share"]


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


def chart_with_stress(wildcards):
    """The chart and, where its stress is limited, that of each coating."""
    limited = "fatigue" in config["chart"]["limits"]
    return [
        rules.chart_table.output.table,
        *(rules.chart_stress.output[:1] if limited else []),
    ]


def charted_maps(wildcards):
    """Maps of those coatings of the study that are on the casing and have an angle of the chart."""
    chart = config["chart"]
    return [
        map_of(case)
        for case in coating_cases(STUDY)
        if not (case.is_rigid or case.variant)
        and case.casing == chart["casing"]
        and case.theta in chart["theta"]
    ]


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
    benchmark:
        f"{RESULTS}/benchmarks/chart_column/{{column}}.tsv"
    wildcard_constraints:
        column="[A-Za-z0-9]+_E[^_/]+_theta[^_/]+",
    threads: lambda wildcards: threads_for(1, len(chart_columns()), workflow.resource_settings.cores)
    resources:
        mem_mb=memory_mb,
        runtime=lambda wildcards, attempt: attempt * (2 + len(config["chart"]["K"])),  # a tenth of it measured
    params:
        plan=planned_points,
    script:
        "scripts/chart_column.py"


rule chart_table:
    input:
        manifests=chart_manifests,
        analysing=files_behind("extras.chart.table", "study.peaks"),
    output:
        **described(table=f"{TABLES}/chart.csv"),
    log:
        f"{RESULTS}/logs/chart_table.log",
    params:
        peaks=config["analysis"]["peaks"] | {"orders": CHART_ORDERS},
    script:
        "scripts/chart_table.py"


rule chart_stress:
    # only where the config has a fatigue limit
    input:
        table=rules.chart_table.output.table,
        blade=rules.blade.output.reduced_model,
        mesh=rules.blade.output.mesh,
        kernel=rules.compile_kernel.output[0],
        analysing=files_behind("extras.chart.stress"),
    output:
        **described(table=f"{TABLES}/chart_stress.csv"),
    log:
        f"{RESULTS}/logs/chart_stress.log",
    benchmark:
        f"{RESULTS}/benchmarks/chart_stress.tsv"
    resources:
        mem_mb=memory_mb,
        runtime=minutes(60),
    script:
        "scripts/chart_stress.py"


rule chart_maps:
    # one job, because to start it takes longer than to draw one
    input:
        table=rules.chart_table.output[0],
        drawing=files_behind("extras.plots.chart_moduli", "plots.titles"),
    output:
        png=[
            shown(
                f"{PLOTS}/chart_{name}.png",
                PEAK_CAPTIONS.get(name, f"chart_{name}"),
                "8. Choice of a coating",
                title=f"Chart: {name}" if name in PEAK_CAPTIONS else None,
            )
            for name in CHARTED
        ],
        pdf=[f"{PLOTS}/chart_{name}.pdf" for name in CHARTED],
    log:
        f"{RESULTS}/logs/chart_maps.log",
    params:
        dpi=DPI,
        quantities=CHARTED,
        modulus_unit=modulus_unit(STUDY),
    script:
        "scripts/chart_maps.py"


rule chart_choice:
    # what the limits leave: a map, the front of the best coatings, and one to recommend
    input:
        tables=chart_with_stress,
        analysing=files_behind("extras.chart.choice", "extras.chart.stress"),
        drawing=files_behind("extras.plots.chart_moduli", "extras.plots.chart_pareto", "plots.titles"),
    output:
        **drawn_together(["chart_safe", "chart_pareto"], "8. Choice of a coating", with_data=False),
        **described(pareto=f"{TABLES}/chart_pareto.csv", choice=f"{TABLES}/chart_choice.csv"),
    log:
        f"{RESULTS}/logs/chart_choice.log",
    params:
        dpi=DPI,
        modulus_unit=modulus_unit(STUDY),
        limits=config["chart"]["limits"],
    script:
        "scripts/chart_choice.py"


rule chart_peaks:
    # ridges of the peaks, and what their heights and speeds follow
    input:
        manifests=chart_manifests,
        blade=rules.blade.output.reduced_model,
        analysing=files_behind(
            "extras.chart.table",
            "extras.chart.ridge",
            "extras.chart.stiffening",
            "study.peaks",
        ),
        drawing=files_behind("extras.plots.chart_peaks", "plots.titles"),
    output:
        **drawn_together(
            ["chart_explanation", "chart_stiffening"],
            "8. Choice of a coating",
            with_data=False,
        ),
        **described(
            ridge=f"{TABLES}/chart_ridge.csv",
            ridge_summary=f"{TABLES}/chart_ridge_summary.csv",
            explanation=f"{TABLES}/chart_explanation.csv",
            stiffening=f"{TABLES}/chart_stiffening.csv",
        ),
    log:
        f"{RESULTS}/logs/chart_peaks.log",
    params:
        dpi=DPI,
        peaks=config["analysis"]["peaks"] | {"orders": CHART_ORDERS},
        modulus_unit=modulus_unit(STUDY),
    script:
        "scripts/chart_peaks.py"


rule chart_placement:
    # how well the search does, from the study alone: `snakemake results/tables/chart_placement.csv`
    input:
        maps=charted_maps,
        analysing=files_behind(
            "extras.chart.search",
            "extras.chart.check",
            "study.peaks",
        ),
    output:
        **described(
            table=f"{TABLES}/chart_placement.csv",
            summary=f"{TABLES}/chart_placement_summary.csv",
        ),
    log:
        f"{RESULTS}/logs/chart_placement.log",
    params:
        peaks=config["analysis"]["peaks"] | {"orders": CHART_ORDERS},
        speeds=config["chart"]["speeds"],
    script:
        "scripts/chart_placement.py"


rule chart_agreement:
    # needs both the chart and the study: `snakemake results/tables/chart_agreement.csv`
    input:
        chart=rules.chart_table.output[0],
        placement=rules.chart_placement.output[0],
        analysing=files_behind("extras.chart.check"),
    output:
        **described(table=f"{TABLES}/chart_agreement.csv"),
    log:
        f"{RESULTS}/logs/chart_agreement.log",
    script:
        "scripts/chart_agreement.py"


rule chart:
    input:
        rules.chart_table.output,
        rules.chart_maps.output,
        rules.chart_choice.output,
        rules.chart_peaks.output,


localrules:
    chart,


PICTURES["chart_images"] = {
    f"studies/chart/images/chart_{name}.png": Picture(f"{PLOTS}/chart_{name}.png", 20)
    for name in ("Y4", "safe", "pareto", "explanation", "stiffening")
}
