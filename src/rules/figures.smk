# The figures of the paper by number, drawn from nothing but their inputs: a script for each kind of figure. A
# figure is planned only if the study has its coatings.
from dataclasses import asdict
from typing import NamedTuple

from bladerub.study.grid import (
    CoatingCase,
    keeps_history,
    modulus_unit,
    run_spec,
    speed_name,
    speeds,
)
from bladerub.study.orders import peak_orders, peak_settings, used_casings
from bladerub.study.paper import (
    CRITICAL,
    SOFT,
    STRAIGHT,
    STRAIGHT_SPEED,
    TILTED,
    TILTED_SPEED,
    WORN,
)

MODULI = "casing == '2nd' and theta == 0 and law == 'theta'"  # the coatings of the histograms
BLADE = {"blade": rules.blade.output.reduced_model}

# What E = 1 is, a displacement that is large, and what is known of the rotor but the first frequency of its blade
SCALES = {
    "modulus_unit": modulus_unit(STUDY),
    "length": config["blade"]["length"],
    "engine": {"nominal_speed": config["figures"].get("nominal_speed")},
}
SCALED = {"dpi": DPI, "scales": SCALES}
SPECTRUM = SCALED | {key: config["figures"][key] for key in ("max_frequency", "amplitude_range")}

# Speeds at which the displacement of both is kept: the paper's two, and those where this blade has its peaks
BOTH = [
    f
    for f in speeds(STUDY)
    if {STRAIGHT, TILTED} <= set(coating_cases(STUDY))
    and all(keeps_history(STUDY, case, f) for case in (STRAIGHT, TILTED))
]
OWN = [f_omega for f_omega in BOTH if f_omega not in (TILTED_SPEED, STRAIGHT_SPEED)]


def in_study(*cases):
    return {case.name for case in cases} <= set(COATINGS)


def map_of(case):
    return f"{RESULTS}/maps/{case.name}.h5"


def part_of_run(case, part):
    """One part of what is simulated on a coating; looked up only for a figure that is planned."""
    return lambda wildcards: asdict(getattr(run_spec(STUDY, case, 0.0), part))


# Of any casing and coating, for the asking; on what the paper does not show also part of `all`
rule casing:
    input:
        **BLADE,
        model=files_behind("contact.casing"),
        drawing=files_behind("plots.polar"),
    output:
        **described(data=f"{PLOTS}/casing/{{casing}}.csv"),
        png=f"{PLOTS}/casing/{{casing}}.png",
        pdf=f"{PLOTS}/casing/{{casing}}.pdf",
    log:
        f"{RESULTS}/logs/casing/{{casing}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/casing/{{casing}}.tsv"
    wildcard_constraints:
        casing="|".join(config["casings"]),
    group:
        "drawing"
    params:
        dpi=DPI,
        casing=lambda wildcards: part_of_run(CoatingCase.rigid(wildcards.casing, 0.0), "casing")(wildcards),
    script:
        "../scripts/casing.py"


rule wear_map:
    input:
        **BLADE,
        map=rules.coating.output.map,
        drawing=files_behind("plots.wear_map"),
    output:
        png=f"{PLOTS}/wear_map/{{coating}}.png",
        pdf=f"{PLOTS}/wear_map/{{coating}}.pdf",
    log:
        f"{RESULTS}/logs/wear_map/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/wear_map/{{coating}}.tsv"
    group:
        "drawing"
    params:
        **SCALED,
    script:
        "../scripts/wear_map.py"


rule spectrum:
    input:
        **BLADE,
        map=rules.coating.output.map,
        drawing=files_behind("plots.spectrum"),
    output:
        png=f"{PLOTS}/spectrum/{{coating}}.png",
        pdf=f"{PLOTS}/spectrum/{{coating}}.pdf",
    log:
        f"{RESULTS}/logs/spectrum/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/spectrum/{{coating}}.tsv"
    group:
        "drawing"
    params:
        **SPECTRUM,
    script:
        "../scripts/spectrum.py"


class Figure(NamedTuple):
    """A figure of the paper: where the report shows it, and its job."""

    category: str
    script: str
    input: dict
    params: dict
    is_planned: bool = True
    with_data: bool = True


def spectrum_of(case, category):
    inputs = {**BLADE, "map": map_of(case), "drawing": rules.spectrum.input.drawing}
    return Figure(category, "spectrum", inputs, SPECTRUM, in_study(case), with_data=False)


SINGLE = {
    "fig01_blade": Figure(
        "Model",
        "fig01_blade",
        {
            "mesh": rules.blade.output.mesh,
            "drawing": files_behind("plots.blade_mesh"),
        },
        {"dpi": DPI},
        with_data=False,
    ),
    "fig02_campbell": Figure(
        "Model",
        "fig02_campbell",
        {
            **BLADE,
            "campbell": rules.blade_tables.output.campbell,
            "drawing": files_behind("plots.campbell"),
        },
        SCALED,
    ),
    "fig03_tip_profile": Figure(
        "Model",
        "fig03_tip_profile",
        {
            **BLADE,
            "model": files_behind("contact.illustration"),
            "drawing": files_behind("plots.tip_profile"),
        },
        {
            "dpi": DPI,
            "coating": part_of_run(TILTED, "coating"),
            "tip": part_of_run(TILTED, "tip"),
        },
        in_study(TILTED),
    ),
    "fig04_coating_cycle": Figure(
        "Model",
        "fig04_coating_cycle",
        {
            "model": files_behind("contact.illustration"),
            "drawing": files_behind("plots.coating_cycle"),
        },
        {"dpi": DPI, "coating": part_of_run(STRAIGHT, "coating")},
        in_study(STRAIGHT),
    ),
    "fig05_casing": Figure(
        "Model",
        "casing",
        {
            **BLADE,
            "model": rules.casing.input.model,
            "drawing": rules.casing.input.drawing,
        },
        {"dpi": DPI, "casing": part_of_run(WORN, "casing")},
        in_study(WORN),
    ),
    "fig06_wear_map": Figure(
        "Wear and spectra",
        "wear_map",
        {
            **BLADE,
            "map": map_of(WORN),
            "drawing": rules.wear_map.input.drawing,
        },
        SCALED,
        in_study(WORN),
        with_data=False,
    ),
    "fig07_spectrum_2nd5nd": spectrum_of(WORN, "Wear and spectra"),
    "fig08_spectrum_soft": spectrum_of(SOFT, "Wear and spectra"),
    "fig09_spectrum_critical": spectrum_of(CRITICAL, "Wear and spectra"),
    "fig10_peaks": Figure(
        "Wear and spectra",
        "fig10_peaks",
        {
            **BLADE,
            "map": map_of(SOFT),
            "analysing": files_behind("study.maps", "study.peaks"),
            "drawing": rules.spectrum.input.drawing,
        },
        SPECTRUM | {"peaks": lambda wildcards: peak_settings(STUDY, SOFT.casing).plain()},
        in_study(SOFT),
    ),
    "fig15_spectrum_theta0": spectrum_of(STRAIGHT, "Angle of the elements"),
    "fig16_spectrum_theta015": spectrum_of(TILTED, "Angle of the elements"),
    "fig19_wear_polar": Figure(
        "Angle of the elements",
        "fig19_wear_polar",
        {
            "maps": [map_of(STRAIGHT), map_of(TILTED)],
            "drawing": rules.casing.input.drawing,
        },
        {"dpi": DPI, "speeds": [TILTED_SPEED, STRAIGHT_SPEED, *OWN]},
        in_study(STRAIGHT, TILTED) and {TILTED_SPEED, STRAIGHT_SPEED} <= set(speeds(STUDY)),
    ),
}
for name, figure in SINGLE.items():

    rule:
        name:
            name
        input:
            **figure.input,
        output:
            **drawn(name, figure.category, figure.with_data),
        log:
            f"{RESULTS}/logs/{name}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{name}.tsv"
        group:
            "drawing"
        params:
            **figure.params,
            script=figure.script,
        script:
            "../scripts/{params.script}.py"


# All from one table, so that one job draws them: quantity and engine order of each
HISTOGRAMS = {
    "fig11_Y4": ("amplitude", 4),
    "fig12_f4": ("f_peak", 4),
    "fig13_Y6": ("amplitude", 6),
    "fig14_f6": ("f_peak", 6),
}


rule histograms:
    input:
        peaks=rules.peaks.output[0],
        drawing=files_behind("plots.histogram"),
    output:
        **drawn_together(HISTOGRAMS, "Moduli of the coating"),
    log:
        f"{RESULTS}/logs/histograms.log",
    benchmark:
        f"{RESULTS}/benchmarks/histograms.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        coatings=MODULI,
        figures=HISTOGRAMS,
        modulus_unit=modulus_unit(STUDY),
    script:
        "../scripts/histograms.py"


# Runs of each, which are next to the manifests: Figs. 17 and 18, and the same at speeds of our own
HISTORIES = {
    {TILTED_SPEED: "fig17_history_0190", STRAIGHT_SPEED: "fig18_history_0197"}.get(
        f_omega, f"history_{speed_name(f_omega)}"
    ): [f"{RESULTS}/runs/{case.name}/{speed_name(f_omega)}.h5" for case in (STRAIGHT, TILTED)]
    for f_omega in BOTH
}


rule histories:
    input:
        manifests=expand(rules.coating.output.manifest, coating=[STRAIGHT.name, TILTED.name]),
        drawing=files_behind("plots.history"),
    output:
        **drawn_together(HISTORIES, "Angle of the elements"),
    log:
        f"{RESULTS}/logs/histories.log",
    benchmark:
        f"{RESULTS}/benchmarks/histories.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        scales=SCALES,
        figures=HISTORIES,
    script:
        "../scripts/histories.py"


WITH_MODULI = any(
    case.casing == "2nd" and case.theta == 0 and case.law == "theta" and not case.variant
    for case in coating_cases(STUDY)
) and {4, 6} <= set(peak_orders(STUDY, "2nd"))
# Spectrum and wear map of each coating are drawn on casings that no figure of the paper shows, and in a small study of
# others than the paper's
OF_PAPER = [WORN, SOFT, CRITICAL, STRAIGHT, TILTED]
SHOWN = {case.casing for case in OF_PAPER if in_study(case)}
if len(COATINGS) <= 12 and not in_study(*OF_PAPER):
    SHOWN = set()
OTHER = [case.name for case in coating_cases(STUDY) if case.casing not in SHOWN]
PLANNED = {
    **{name: figure.is_planned for name, figure in SINGLE.items()},
    "histograms": WITH_MODULI,
    "histories": bool(BOTH),
}
# What `rule all` asks for
FIGURES = [getattr(rules, name).output for name, needed in PLANNED.items() if needed]
FIGURES += [expand(rules.spectrum.output, coating=OTHER)]
# On a blade from another program, the wear map of every coating that can wear, and every casing
ON_OTHER_BLADE = "source" in config["blade"]
WEARING = [
    case.name for case in coating_cases(STUDY) if not case.is_rigid and (ON_OTHER_BLADE or case.name in OTHER)
]
FIGURES += [expand(rules.wear_map.output, coating=WEARING)]
CASINGS = used_casings(STUDY) if ON_OTHER_BLADE else []
FIGURES += [expand(rules.casing.output, casing=CASINGS)]
