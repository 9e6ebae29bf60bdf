# The figures of the paper by number, drawn from nothing but their inputs: a table, a row a job, and a script for each
# kind of figure. A figure is planned only if the study has its coatings.
from dataclasses import asdict
from typing import NamedTuple

from bladerub.study.grid import CoatingCase, keeps_history, modulus_unit, run_spec, speed_name, speeds
from bladerub.study.peaks import peak_orders, peak_settings, used_casings
from bladerub.study.paper import CRITICAL, SOFT, STRAIGHT, STRAIGHT_SPEED, TILTED, TILTED_SPEED, WORN


def in_study(*cases):
    return {case.name for case in cases} <= set(COATINGS)


def map_of(case):
    return MAP.format(coating=case.name)


def part_of_run(case, part):
    """One part of what is simulated on a coating; looked up only for a figure that is planned."""
    return lambda wildcards: asdict(getattr(run_spec(STUDY, case, 0.0), part))


MODULI = "casing == '2nd' and theta == 0 and law == 'theta'"  # the coatings of the histograms
WITH_MODULI = any(
    case.casing == "2nd" and case.theta == 0 and case.law == "theta" and not case.variant
    for case in coating_cases(STUDY)
) and {4, 6} <= set(peak_orders(STUDY, "2nd"))

# What E = 1 is, a displacement that is large, and what is known of the rotor but the first frequency of its blade
SCALES = {
    "modulus_unit": modulus_unit(STUDY),
    "length": config["blade"]["length"],
    "nominal_speed": config["figures"].get("nominal_speed"),
}
PLAIN = {"dpi": DPI}
SCALED = PLAIN | {"scales": SCALES}
SPECTRUM = SCALED | {key: config["figures"][key] for key in ("max_frequency", "amplitude_range")}

# Speeds at which the displacement of both is kept: the paper's two, and those where this blade has its peaks
BOTH = [
    f_omega
    for f_omega in speeds(STUDY)
    if in_study(STRAIGHT, TILTED) and all(keeps_history(STUDY, case, f_omega) for case in (STRAIGHT, TILTED))
]
FIGURES_OF_SPEED = {TILTED_SPEED: "fig17_history_0190", STRAIGHT_SPEED: "fig18_history_0197"}
OWN = [f_omega for f_omega in BOTH if f_omega not in FIGURES_OF_SPEED]
# Runs of each, which are next to the manifests: those of the paper, and the same at speeds of our own
HISTORIES = {
    FIGURES_OF_SPEED.get(f_omega, f"history_{speed_name(f_omega)}"): [
        f"{RESULTS}/runs/{case.name}/{speed_name(f_omega)}.h5" for case in (STRAIGHT, TILTED)
    ]
    for f_omega in BOTH
}
# All from one table, so that one job draws them: quantity and engine order of each
HISTOGRAMS = {
    "fig11_Y4": ("amplitude", 4),
    "fig12_f4": ("f_peak", 4),
    "fig13_Y6": ("amplitude", 6),
    "fig14_f6": ("f_peak", 6),
}


class Figure(NamedTuple):
    """The job of one figure, or of those in ``params["figures"]``."""

    category: str | None  # where the report shows it
    code: list[str]  # modules behind it
    input: dict
    params: dict
    is_planned: bool = True
    with_data: bool = True
    script: str = ""  # by default that of its name


BLADE = {"blade": rules.blade.output.reduced_model}


def of_casing(shape, category=None, is_planned=False):
    code, params = ["contact.casing", "plots.polar"], PLAIN | {"casing": shape}
    return Figure(category, code, BLADE, params, is_planned, script="casing")


def of_map(kind, params, map, category=None, is_planned=False):
    inputs = BLADE | {"map": map}
    return Figure(category, ["plots.maps"], inputs, params, is_planned, with_data=False, script=kind)


def spectrum_of(case, category):
    return of_map("spectrum", SPECTRUM, map_of(case), category, in_study(case))


JOBS = {
    # Of any casing and coating, for the asking; on what the paper does not show also part of `all`
    "casing/{casing}": of_casing(
        lambda wildcards: asdict(run_spec(STUDY, CoatingCase.rigid(wildcards.casing, 0.0), 0.0).casing)
    ),
    "wear_map/{coating}": of_map("wear_map", SCALED, rules.coating.output.map),
    "spectrum/{coating}": of_map("spectrum", SPECTRUM, rules.coating.output.map),
    "fig01_blade": Figure(
        "Model", ["plots.blade_mesh"], {"mesh": rules.blade.output.mesh}, PLAIN, with_data=False
    ),
    "fig02_campbell": Figure(
        "Model", ["plots.campbell"], BLADE | {"campbell": rules.blade_tables.output.campbell}, SCALED
    ),
    "fig03_tip_profile": Figure(
        "Model",
        ["contact.illustration", "plots.illustration"],
        BLADE,
        PLAIN | {part: part_of_run(TILTED, part) for part in ("coating", "tip")},
        in_study(TILTED),
    ),
    "fig04_coating_cycle": Figure(
        "Model",
        ["contact.illustration", "plots.illustration"],
        {},
        PLAIN | {"coating": part_of_run(STRAIGHT, "coating")},
        in_study(STRAIGHT),
    ),
    "fig05_casing": of_casing(part_of_run(WORN, "casing"), "Model", in_study(WORN)),
    "fig06_wear_map": of_map("wear_map", SCALED, map_of(WORN), "Wear and spectra", in_study(WORN)),
    "fig07_spectrum_2nd5nd": spectrum_of(WORN, "Wear and spectra"),
    "fig08_spectrum_soft": spectrum_of(SOFT, "Wear and spectra"),
    "fig09_spectrum_critical": spectrum_of(CRITICAL, "Wear and spectra"),
    "fig10_peaks": Figure(
        "Wear and spectra",
        ["study.maps", "study.peaks", "plots.maps"],
        BLADE | {"map": map_of(SOFT)},
        SPECTRUM | {"peaks": lambda wildcards: peak_settings(STUDY, SOFT.casing).plain()},
        in_study(SOFT),
    ),
    "histograms": Figure(
        "Moduli of the coating",
        ["plots.histogram"],
        {"peaks": rules.peaks.output[0]},
        PLAIN | {"figures": HISTOGRAMS, "coatings": MODULI, "modulus_unit": modulus_unit(STUDY)},
        WITH_MODULI,
    ),
    "fig15_spectrum_theta0": spectrum_of(STRAIGHT, "Angle of the elements"),
    "fig16_spectrum_theta015": spectrum_of(TILTED, "Angle of the elements"),
    "histories": Figure(
        "Angle of the elements",
        ["plots.runs"],
        BLADE | {"manifests": expand(rules.coating.output.manifest, coating=[STRAIGHT.name, TILTED.name])},
        SCALED | {"figures": HISTORIES},
        bool(BOTH),
    ),
    "fig19_wear_polar": Figure(
        "Angle of the elements",
        ["plots.polar"],
        BLADE | {"maps": [map_of(STRAIGHT), map_of(TILTED)]},
        PLAIN | {"speeds": [TILTED_SPEED, STRAIGHT_SPEED, *OWN]},
        in_study(STRAIGHT, TILTED) and {TILTED_SPEED, STRAIGHT_SPEED} <= set(speeds(STUDY)),
    ),
}
for name, figure in JOBS.items():

    rule:
        name:
            name.partition("/")[0]
        input:
            **figure.input,
            code=sorted({path for module in figure.code for path in files_behind(module)}),
        output:
            **(
                drawn_together(figure.params["figures"], figure.category)
                if "figures" in figure.params
                else drawn(name, figure.category, figure.with_data)
            ),
        log:
            f"{RESULTS}/logs/{name}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{name}.tsv"
        group:
            "drawing"
        params:
            **figure.params,
            script=figure.script or name,
        script:
            "../scripts/{params.script}.py"


# Spectrum and wear map of each coating are drawn on casings that no figure of the paper shows, and in a small study of
# others than the paper's
OF_PAPER = [WORN, SOFT, CRITICAL, STRAIGHT, TILTED]
SHOWN = {case.casing for case in OF_PAPER if in_study(case)}
if len(COATINGS) <= 12 and not in_study(*OF_PAPER):
    SHOWN = set()
OTHER = [case.name for case in coating_cases(STUDY) if case.casing not in SHOWN]
# On a blade from another program, the wear map of every coating that can wear, and every casing
ON_OTHER_BLADE = "source" in config["blade"]
WEARING = [
    case.name for case in coating_cases(STUDY) if not case.is_rigid and (ON_OTHER_BLADE or case.name in OTHER)
]
# What `rule all` asks for
FIGURES = [
    *(getattr(rules, name).output for name, figure in JOBS.items() if figure.is_planned),
    expand(rules.spectrum.output, coating=OTHER),
    expand(rules.wear_map.output, coating=WEARING),
    expand(rules.casing.output, casing=used_casings(STUDY) if ON_OTHER_BLADE else []),
]
