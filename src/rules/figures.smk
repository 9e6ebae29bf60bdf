# The figures of the paper by number, drawn from nothing but their inputs: a script for each kind of figure. A
# figure is planned only if the study has its coatings.
from dataclasses import asdict

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
SPECTRA = {
    key: config["figures"][key] for key in ("dpi", "max_frequency", "amplitude_range")
}

# What E = 1 is, a displacement that is large, and what is known of the rotor but the first frequency of its blade
SCALES = {
    "modulus_unit": modulus_unit(STUDY),
    "length": config["blade"]["length"],
    "engine": {"nominal_speed": config["figures"].get("nominal_speed")},
}

# Speeds at which the displacement of both is kept: the paper's two, and those where this blade has its peaks
BOTH = [
    f
    for f in speeds(STUDY)
    if {STRAIGHT, TILTED} <= set(coating_cases(STUDY))
    and all(keeps_history(STUDY, case, f) for case in (STRAIGHT, TILTED))
]
OWN = [f_omega for f_omega in BOTH if f_omega not in (TILTED_SPEED, STRAIGHT_SPEED)]


def map_of(case):
    return f"{RESULTS}/maps/{case.name}.h5"


def part_of_run(case, part):
    """One part of what is simulated on a coating; looked up only for a figure that is planned."""
    return lambda wildcards: asdict(getattr(run_spec(STUDY, case, 0.0), part))


rule fig01_blade:
    input:
        mesh=rules.blade.output.mesh,
        drawing=files_behind("plots.blade_mesh"),
    output:
        **drawn("fig01_blade", "Model"),
    log:
        f"{RESULTS}/logs/fig01_blade.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig01_blade.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
    script:
        "../scripts/fig01_blade.py"


rule fig02_campbell:
    input:
        blade=rules.blade.output.reduced_model,
        campbell=rules.blade_tables.output.campbell,
        drawing=files_behind("plots.campbell"),
    output:
        **drawn("fig02_campbell", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig02_campbell.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig02_campbell.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        scales=SCALES,
    script:
        "../scripts/fig02_campbell.py"


rule fig03_tip_profile:
    input:
        blade=rules.blade.output.reduced_model,
        model=files_behind("contact.illustration"),
        drawing=files_behind("plots.tip_profile"),
    output:
        **drawn("fig03_tip_profile", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig03_tip_profile.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig03_tip_profile.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        coating=part_of_run(TILTED, "coating"),
        tip=part_of_run(TILTED, "tip"),
    script:
        "../scripts/fig03_tip_profile.py"


rule fig04_coating_cycle:
    input:
        model=files_behind("contact.illustration"),
        drawing=files_behind("plots.coating_cycle"),
    output:
        **drawn("fig04_coating_cycle", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig04_coating_cycle.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig04_coating_cycle.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        coating=part_of_run(STRAIGHT, "coating"),
    script:
        "../scripts/fig04_coating_cycle.py"


# Of any casing, for the asking; of another blade also part of `all`
rule casing:
    input:
        blade=rules.blade.output.reduced_model,
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
        casing=lambda wildcards: part_of_run(
            CoatingCase.rigid(wildcards.casing, 0.0), "casing"
        )(wildcards),
    script:
        "../scripts/casing.py"


use rule casing as fig05_casing with:
    output:
        **drawn("fig05_casing", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig05_casing.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig05_casing.tsv"
    params:
        casing=part_of_run(WORN, "casing"),


# Of any coating, for the asking; of another blade or casing also part of `all`
rule wear_map:
    input:
        map=rules.coating.output.map,
        blade=rules.blade.output.reduced_model,
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
        dpi=DPI,
        scales=SCALES,
    script:
        "../scripts/wear_map.py"


use rule wear_map as fig06_wear_map with:
    input:
        map=map_of(WORN),
        blade=rules.blade.output.reduced_model,
        drawing=rules.wear_map.input.drawing,
    output:
        **drawn("fig06_wear_map", "Wear and spectra"),
    log:
        f"{RESULTS}/logs/fig06_wear_map.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig06_wear_map.tsv"


rule spectrum:
    input:
        map=rules.coating.output.map,
        blade=rules.blade.output.reduced_model,
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
        **SPECTRA,
        scales=SCALES,
    script:
        "../scripts/spectrum.py"


# The paper's spectra, each of one coating: drawn as that of any coating is
OF_SPECTRA = {
    "fig07_spectrum_2nd5nd": (WORN, "Wear and spectra"),
    "fig08_spectrum_soft": (SOFT, "Wear and spectra"),
    "fig09_spectrum_critical": (CRITICAL, "Wear and spectra"),
    "fig15_spectrum_theta0": (STRAIGHT, "Angle of the elements"),
    "fig16_spectrum_theta015": (TILTED, "Angle of the elements"),
}
for figure, (case, category) in OF_SPECTRA.items():

    rule:
        name:
            figure
        input:
            map=map_of(case),
            blade=rules.blade.output.reduced_model,
            drawing=rules.spectrum.input.drawing,
        output:
            **drawn(figure, category),
        log:
            f"{RESULTS}/logs/{figure}.log",
        benchmark:
            f"{RESULTS}/benchmarks/{figure}.tsv"
        group:
            "drawing"
        params:
            **SPECTRA,
            scales=SCALES,
        script:
            "../scripts/spectrum.py"


rule fig10_peaks:
    input:
        map=map_of(SOFT),
        blade=rules.blade.output.reduced_model,
        analysing=files_behind("study.maps", "study.peaks"),
        drawing=rules.spectrum.input.drawing,
    output:
        **drawn("fig10_peaks", "Wear and spectra", with_data=True),
    log:
        f"{RESULTS}/logs/fig10_peaks.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig10_peaks.tsv"
    group:
        "drawing"
    params:
        **SPECTRA,
        scales=SCALES,
        peaks=lambda wildcards: peak_settings(STUDY, SOFT.casing).plain(),
    script:
        "../scripts/fig10_peaks.py"


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
    ): [
        f"{RESULTS}/runs/{case.name}/{speed_name(f_omega)}.h5"
        for case in (STRAIGHT, TILTED)
    ]
    for f_omega in BOTH
}


rule histories:
    input:
        manifests=expand(
            rules.coating.output.manifest, coating=[STRAIGHT.name, TILTED.name]
        ),
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


rule fig19_wear_polar:
    input:
        maps=[map_of(STRAIGHT), map_of(TILTED)],
        drawing=files_behind("plots.polar"),
    output:
        **drawn("fig19_wear_polar", "Angle of the elements", with_data=True),
    log:
        f"{RESULTS}/logs/fig19_wear_polar.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig19_wear_polar.tsv"
    group:
        "drawing"
    params:
        dpi=DPI,
        speeds=[TILTED_SPEED, STRAIGHT_SPEED, *OWN],
    script:
        "../scripts/fig19_wear_polar.py"


def in_study(*cases):
    return {case.name for case in cases} <= set(COATINGS)


WITH_MODULI = any(
    case.casing == "2nd"
    and case.theta == 0
    and case.law == "theta"
    and not case.variant
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
    "fig01_blade": True,
    "fig02_campbell": True,
    "fig03_tip_profile": in_study(TILTED),
    "fig04_coating_cycle": in_study(STRAIGHT),
    "fig05_casing": in_study(WORN),
    "fig06_wear_map": in_study(WORN),
    **{figure: in_study(case) for figure, (case, _) in OF_SPECTRA.items()},
    "fig10_peaks": in_study(SOFT),
    "histograms": WITH_MODULI,
    "histories": bool(BOTH),
    "fig19_wear_polar": in_study(STRAIGHT, TILTED)
    and {TILTED_SPEED, STRAIGHT_SPEED} <= set(speeds(STUDY)),
}
# What `rule all` asks for
FIGURES = [getattr(rules, name).output for name, needed in PLANNED.items() if needed]
FIGURES += [expand(rules.spectrum.output, coating=OTHER)]
# On a blade from another program, the wear map of every coating that can wear, and every casing
ON_OTHER_BLADE = "source" in config["blade"]
WEARING = [
    case.name
    for case in coating_cases(STUDY)
    if not case.is_rigid and (ON_OTHER_BLADE or case.name in OTHER)
]
FIGURES += [expand(rules.wear_map.output, coating=WEARING)]
CASINGS = used_casings(STUDY) if ON_OTHER_BLADE else []
FIGURES += [expand(rules.casing.output, casing=CASINGS)]
