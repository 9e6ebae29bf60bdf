# The figures of the paper by number: one rule and one script each, drawn from nothing but their inputs. A
# figure is planned only if the study has its coatings.
from dataclasses import asdict

from bladerub.study.grid import CoatingCase, keeps_history, run_spec, speed_name, speeds

LOBED = CoatingCase("2nd5nd", 11.0, 0.5, 0.0)
SOFT = CoatingCase("2nd", 0.11, 0.5, 0.0)
CRITICAL = CoatingCase("2nd", 1.1, 0.5, 0.0)
STRAIGHT = CoatingCase("2nd", 2.0, 0.5, 0.0)
INCLINED = CoatingCase("2nd", 2.0, 0.5, 0.15)
MODULI = "casing == '2nd' and theta == 0 and law == 'theta'"  # the coatings of the histograms

CASING_RADIUS = config["blade"]["hub_radius"] + config["blade"]["length"]
DPI = config["figures"]["dpi"]
SPECTRA = {
    key: config["figures"][key] for key in ("dpi", "max_frequency", "amplitude_range")
}
PLOTS = f"{RESULTS}/figures"


# Speeds at which the displacement of both is kept: the paper's two, and those where this blade has its peaks
BOTH = [
    f
    for f in speeds(config)
    if all(keeps_history(config, case, f) for case in (STRAIGHT, INCLINED))
]
OWN = [f_omega for f_omega in BOTH if f_omega not in (0.190, 0.197)]


def map_of(case):
    return f"{RESULTS}/maps/{case.name}.h5"


def runs_at(f_omega):
    """Runs whose displacement is kept, straight and inclined; they lie beside the manifests."""
    return [
        f"{RESULTS}/runs/{case.name}/{speed_name(f_omega)}.h5"
        for case in (STRAIGHT, INCLINED)
    ]


def drawn(name, category, with_data=False):
    """The files of a figure; the one with a speed in its name has one caption for all."""
    files = {
        "png": shown(f"{PLOTS}/{name}.png", name.split("_{")[0], category),
        "pdf": f"{PLOTS}/{name}.pdf",
    }
    if with_data:
        files["data"] = f"{PLOTS}/{name}.csv"
        files["description"] = f"{PLOTS}/{name}.csv-metadata.json"
    return files


rule fig01_blade:
    input:
        mesh=rules.blade.output.mesh,
        drawing=files_behind("plots.blade_mesh", "plots.surface"),
    output:
        **drawn("fig01_blade", "Model"),
    log:
        f"{RESULTS}/logs/fig01_blade.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig01_blade.tsv"
    threads: 1
    params:
        dpi=DPI,
    script:
        "../scripts/fig01_blade.py"


rule fig02_campbell:
    input:
        blade=rules.blade.output.reduced_model,
        campbell=rules.blade.output.campbell,
        drawing=files_behind("plots.campbell", "plots.engine_orders"),
    output:
        **drawn("fig02_campbell", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig02_campbell.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig02_campbell.tsv"
    threads: 1
    params:
        dpi=DPI,
    script:
        "../scripts/fig02_campbell.py"


rule fig03_tip_profile:
    input:
        model=files_behind("contact.law", "contact.tip"),
        drawing=files_behind("plots.tip_profile"),
    output:
        **drawn("fig03_tip_profile", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig03_tip_profile.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig03_tip_profile.tsv"
    threads: 1
    params:
        dpi=DPI,
        coating=lambda wildcards: asdict(run_spec(config, INCLINED, 0.0).coating),
        tip=lambda wildcards: asdict(run_spec(config, INCLINED, 0.0).tip),
        casing_radius=CASING_RADIUS,
    script:
        "../scripts/fig03_tip_profile.py"


rule fig04_coating_cycle:
    input:
        model=files_behind("contact.law"),
        drawing=files_behind("plots.coating_cycle"),
    output:
        **drawn("fig04_coating_cycle", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig04_coating_cycle.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig04_coating_cycle.tsv"
    threads: 1
    params:
        dpi=DPI,
        coating=lambda wildcards: asdict(run_spec(config, STRAIGHT, 0.0).coating),
    script:
        "../scripts/fig04_coating_cycle.py"


rule fig05_casing:
    input:
        model=files_behind("contact.casing"),
        drawing=files_behind("plots.casing_polar", "plots.polar"),
    output:
        **drawn("fig05_casing", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/fig05_casing.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig05_casing.tsv"
    threads: 1
    params:
        dpi=DPI,
        casing=lambda wildcards: asdict(run_spec(config, LOBED, 0.0).casing),
        casing_radius=CASING_RADIUS,
    script:
        "../scripts/fig05_casing.py"


rule fig06_wear_map:
    input:
        map=map_of(LOBED),
        drawing=files_behind("plots.wear_map", "plots.cells", "plots.titles"),
    output:
        **drawn("fig06_wear_map", "Wear and spectra"),
    log:
        f"{RESULTS}/logs/fig06_wear_map.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig06_wear_map.tsv"
    threads: 1
    params:
        dpi=DPI,
    script:
        "../scripts/fig06_wear_map.py"


# The same of any coating, for the asking: not part of `all`
rule wear_map:
    input:
        map=rules.map.output,
        drawing=files_behind("plots.wear_map", "plots.cells", "plots.titles"),
    output:
        png=f"{PLOTS}/wear_map/{{coating}}.png",
        pdf=f"{PLOTS}/wear_map/{{coating}}.pdf",
    log:
        f"{RESULTS}/logs/wear_map/{{coating}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/wear_map/{{coating}}.tsv"
    threads: 1
    params:
        dpi=DPI,
    script:
        "../scripts/fig06_wear_map.py"


rule fig07_spectrum_2nd5nd:
    input:
        map=map_of(LOBED),
        drawing=files_behind(
            "plots.spectrum_map", "plots.cells", "plots.engine_orders", "plots.titles"
        ),
    output:
        **drawn("fig07_spectrum_2nd5nd", "Wear and spectra"),
    log:
        f"{RESULTS}/logs/fig07_spectrum_2nd5nd.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig07_spectrum_2nd5nd.tsv"
    threads: 1
    params:
        **SPECTRA,
    script:
        "../scripts/fig07_spectrum_2nd5nd.py"


rule fig08_spectrum_soft:
    input:
        map=map_of(SOFT),
        drawing=files_behind(
            "plots.spectrum_map", "plots.cells", "plots.engine_orders", "plots.titles"
        ),
    output:
        **drawn("fig08_spectrum_soft", "Wear and spectra"),
    log:
        f"{RESULTS}/logs/fig08_spectrum_soft.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig08_spectrum_soft.tsv"
    threads: 1
    params:
        **SPECTRA,
    script:
        "../scripts/fig08_spectrum_soft.py"


rule fig09_spectrum_critical:
    input:
        map=map_of(CRITICAL),
        drawing=files_behind(
            "plots.spectrum_map", "plots.cells", "plots.engine_orders", "plots.titles"
        ),
    output:
        **drawn("fig09_spectrum_critical", "Wear and spectra"),
    log:
        f"{RESULTS}/logs/fig09_spectrum_critical.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig09_spectrum_critical.tsv"
    threads: 1
    params:
        **SPECTRA,
    script:
        "../scripts/fig09_spectrum_critical.py"


rule fig10_peaks:
    input:
        map=map_of(SOFT),
        analysing=files_behind("study.peaks"),
        drawing=files_behind(
            "plots.peak_sections",
            "plots.spectrum_map",
            "plots.cells",
            "plots.engine_orders",
            "plots.titles",
        ),
    output:
        **drawn("fig10_peaks", "Wear and spectra", with_data=True),
    log:
        f"{RESULTS}/logs/fig10_peaks.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig10_peaks.tsv"
    threads: 1
    params:
        **SPECTRA,
        peaks=config["analysis"]["peaks"],
    script:
        "../scripts/fig10_peaks.py"


rule fig11_Y4:
    input:
        peaks=rules.peaks.output[0],
        drawing=files_behind("plots.histogram"),
    output:
        **drawn("fig11_Y4", "Moduli of the coating", with_data=True),
    log:
        f"{RESULTS}/logs/fig11_Y4.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig11_Y4.tsv"
    threads: 1
    params:
        dpi=DPI,
        coatings=MODULI,
    script:
        "../scripts/fig11_Y4.py"


rule fig12_f4:
    input:
        peaks=rules.peaks.output[0],
        drawing=files_behind("plots.histogram"),
    output:
        **drawn("fig12_f4", "Moduli of the coating", with_data=True),
    log:
        f"{RESULTS}/logs/fig12_f4.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig12_f4.tsv"
    threads: 1
    params:
        dpi=DPI,
        coatings=MODULI,
    script:
        "../scripts/fig12_f4.py"


rule fig13_Y6:
    input:
        peaks=rules.peaks.output[0],
        drawing=files_behind("plots.histogram"),
    output:
        **drawn("fig13_Y6", "Moduli of the coating", with_data=True),
    log:
        f"{RESULTS}/logs/fig13_Y6.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig13_Y6.tsv"
    threads: 1
    params:
        dpi=DPI,
        coatings=MODULI,
    script:
        "../scripts/fig13_Y6.py"


rule fig14_f6:
    input:
        peaks=rules.peaks.output[0],
        drawing=files_behind("plots.histogram"),
    output:
        **drawn("fig14_f6", "Moduli of the coating", with_data=True),
    log:
        f"{RESULTS}/logs/fig14_f6.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig14_f6.tsv"
    threads: 1
    params:
        dpi=DPI,
        coatings=MODULI,
    script:
        "../scripts/fig14_f6.py"


rule fig15_spectrum_theta0:
    input:
        map=map_of(STRAIGHT),
        drawing=files_behind(
            "plots.spectrum_map", "plots.cells", "plots.engine_orders", "plots.titles"
        ),
    output:
        **drawn("fig15_spectrum_theta0", "Angle of the elements"),
    log:
        f"{RESULTS}/logs/fig15_spectrum_theta0.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig15_spectrum_theta0.tsv"
    threads: 1
    params:
        **SPECTRA,
    script:
        "../scripts/fig15_spectrum_theta0.py"


rule fig16_spectrum_theta015:
    input:
        map=map_of(INCLINED),
        drawing=files_behind(
            "plots.spectrum_map", "plots.cells", "plots.engine_orders", "plots.titles"
        ),
    output:
        **drawn("fig16_spectrum_theta015", "Angle of the elements"),
    log:
        f"{RESULTS}/logs/fig16_spectrum_theta015.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig16_spectrum_theta015.tsv"
    threads: 1
    params:
        **SPECTRA,
    script:
        "../scripts/fig16_spectrum_theta015.py"


rule fig17_history_0190:
    input:
        manifests=expand(
            rules.coating.output,
            coating=[STRAIGHT.name, INCLINED.name],
        ),
        drawing=files_behind("plots.history", "plots.titles"),
    output:
        **drawn("fig17_history_0190", "Angle of the elements", with_data=True),
    log:
        f"{RESULTS}/logs/fig17_history_0190.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig17_history_0190.tsv"
    threads: 1
    params:
        dpi=DPI,
        runs=runs_at(0.190),
    script:
        "../scripts/fig17_history_0190.py"


rule fig18_history_0197:
    input:
        manifests=expand(
            rules.coating.output,
            coating=[STRAIGHT.name, INCLINED.name],
        ),
        drawing=files_behind("plots.history", "plots.titles"),
    output:
        **drawn("fig18_history_0197", "Angle of the elements", with_data=True),
    log:
        f"{RESULTS}/logs/fig18_history_0197.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig18_history_0197.tsv"
    threads: 1
    params:
        dpi=DPI,
        runs=runs_at(0.197),
    script:
        "../scripts/fig18_history_0197.py"


rule history:
    # as Figs. 17 and 18, at a speed of our own
    input:
        manifests=expand(
            rules.coating.output,
            coating=[STRAIGHT.name, INCLINED.name],
        ),
        drawing=files_behind("plots.history", "plots.titles"),
    output:
        **drawn("history_{speed}", "Angle of the elements", with_data=True),
    log:
        f"{RESULTS}/logs/history/{{speed}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/history/{{speed}}.tsv"
    wildcard_constraints:
        speed=r"\d\.\d{4}",
    threads: 1
    params:
        dpi=DPI,
        runs=lambda wildcards: runs_at(float(wildcards.speed)),
    script:
        "../scripts/history.py"


rule fig19_wear_polar:
    input:
        maps=[map_of(STRAIGHT), map_of(INCLINED)],
        drawing=files_behind("plots.wear_polar", "plots.polar", "plots.titles"),
    output:
        **drawn("fig19_wear_polar", "Angle of the elements", with_data=True),
    log:
        f"{RESULTS}/logs/fig19_wear_polar.log",
    benchmark:
        f"{RESULTS}/benchmarks/fig19_wear_polar.tsv"
    threads: 1
    params:
        dpi=DPI,
        speeds=[0.190, 0.197, *OWN],
    script:
        "../scripts/fig19_wear_polar.py"


# What `rule all` asks for
FIGURES = [rules.fig01_blade.output, rules.fig02_campbell.output]
if INCLINED.name in COATINGS:
    FIGURES += [rules.fig03_tip_profile.output, rules.fig16_spectrum_theta015.output]
if STRAIGHT.name in COATINGS:
    FIGURES += [rules.fig04_coating_cycle.output, rules.fig15_spectrum_theta0.output]
if LOBED.name in COATINGS:
    FIGURES += [
        rules.fig05_casing.output,
        rules.fig06_wear_map.output,
        rules.fig07_spectrum_2nd5nd.output,
    ]
if SOFT.name in COATINGS:
    FIGURES += [rules.fig08_spectrum_soft.output, rules.fig10_peaks.output]
if CRITICAL.name in COATINGS:
    FIGURES += [rules.fig09_spectrum_critical.output]
if set(config["analysis"]["peaks"]["orders"]) >= {4, 6} and any(
    case.casing == "2nd" and case.theta == 0 and case.law == "theta"
    for case in coating_cases(config)
):
    FIGURES += [
        rules.fig11_Y4.output,
        rules.fig12_f4.output,
        rules.fig13_Y6.output,
        rules.fig14_f6.output,
    ]
if 0.190 in BOTH:
    FIGURES += [rules.fig17_history_0190.output]
if 0.197 in BOTH:
    FIGURES += [rules.fig18_history_0197.output]
FIGURES += [expand(rules.history.output, speed=[speed_name(f) for f in OWN])]
if {STRAIGHT.name, INCLINED.name} <= set(COATINGS) and {0.190, 0.197} <= set(
    speeds(config)
):
    FIGURES += [rules.fig19_wear_polar.output]
