# Speed sweeps and long runs, compared with the study (studies/passages/README.md). Not part of `all`.
from bladerub.extras.passages.sweep_grid import DIRECTIONS, sweep_spec

SWEPT = [name for name in COATINGS if name in config["sweeps"]["coatings"]]
SWEEPS = f"{RESULTS}/sweeps/{{coating}}_{{direction}}_{{rate}}.h5"
RATES = [f"{rate:g}" for rate in config["sweeps"]["rates"]]


def swept_maps(wildcards):
    if not SWEPT:
        with bladerub.io.errors.exit_on_error():
            raise bladerub.io.errors.BadInput(
                "sweeps.coatings: the study has none of them; must name some of its coatings"
            )
    return expand(rules.coating.output.map, coating=SWEPT)


def planned_sweep(wildcards):
    """All that determines a sweep but the blade: a changed one is a reason to run."""
    case = case_from_name(STUDY, wildcards.coating)
    with bladerub.io.errors.exit_on_error():
        return asdict(sweep_spec(STUDY, case, wildcards.direction, float(wildcards.rate)))


rule sweeps:
    input:
        blade=rules.blade.output.reduced_model,
        maps=swept_maps,
        sweeps=expand(SWEEPS, coating=SWEPT, direction=DIRECTIONS, rate=RATES),
        analysing=files_behind("extras.passages.sweeps", "study.peaks"),
        drawing=files_behind("extras.plots.passages", "plots.titles"),
    output:
        **drawn("sweeps", "6. Sweeps and long runs"),
        **described(table=shown(f"{TABLES}/sweeps.csv", "sweeps_table", "6. Sweeps and long runs")),
    log:
        f"{RESULTS}/logs/sweeps.log",
    params:
        peaks=PEAKS,
        survival=config["sweeps"]["survival"],
        dpi=DPI,
    script:
        "scripts/sweeps.py"


rule sweep:
    input:
        **SIMULATING,
        analysing=files_behind("extras.passages.sweeps", "extras.passages.sweep_grid", "study.spectra"),
    output:
        SWEEPS,
    log:
        f"{RESULTS}/logs/sweep/{{coating}}_{{direction}}_{{rate}}.log",
    wildcard_constraints:
        direction="|".join(DIRECTIONS),
        rate=r"[0-9.e+-]+",
    resources:
        runtime=minutes(10),
    params:
        spec=planned_sweep,
        spectra=[config["analysis"][key] for key in ("spectrum_revolutions", "max_order")],
    script:
        "scripts/sweep.py"


rule long_runs:
    input:
        long=expand(f"{RESULTS}/long_runs/{{coating}}.h5", coating=COATINGS),
        analysing=files_behind("extras.passages.long_runs", "study.growth"),
        drawing=files_behind("extras.plots.passages", "plots.titles"),
    output:
        **drawn("long_runs", "6. Sweeps and long runs"),
        **described(table=shown(f"{TABLES}/long_runs.csv", "long_runs_table", "6. Sweeps and long runs")),
    log:
        f"{RESULTS}/logs/long_runs.log",
    params:
        divergence=config["analysis"]["divergence"],
        dpi=DPI,
    script:
        "scripts/long_runs.py"


rule long_coating:
    input:
        **SIMULATING,
        map=rules.coating.output.map,
        analysing=files_behind("extras.passages.long_runs", "study.peaks", "study.growth"),
    output:
        f"{RESULTS}/long_runs/{{coating}}.h5",
    log:
        f"{RESULTS}/logs/long_coating/{{coating}}.log",
    resources:
        runtime=minutes(10),
    params:
        revolutions=config["long_runs"]["revolutions"],
        analysis=config["analysis"] | {"peaks": PEAKS},
    script:
        "scripts/long_coating.py"


PICTURES["passage_images"] = {
    f"studies/passages/images/{name}.png": Picture(f"{PLOTS}/{name}.png", 20)
    for name in ("sweeps", "long_runs")
}
