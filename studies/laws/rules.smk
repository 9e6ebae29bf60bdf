# The laws of the elements beside the paper's, drawn as Fig. 4 is. Not part of `all`.
from bladerub import plugins


rule laws:
    input:
        model=files_behind("contact.illustration", "extras.laws.cycles"),
        laws=files_behind(*plugins.offered("LAWS").values()),
    output:
        **drawn("laws", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/laws.log",
    group:
        "drawing"
    params:
        dpi=DPI,
        coating=part_of_run(STRAIGHT, "coating"),
    script:
        "scripts/laws.py"


# How much the heat of the rub changes one run
rule heat:
    input:
        **SIMULATING,
        computing=files_behind("extras.heat", "extras.laws.thermal"),
    output:
        **described(table=f"{TABLES}/heat.csv"),
    log:
        f"{RESULTS}/logs/heat.log",
    resources:
        runtime=minutes(5),
    params:
        simulated=lambda wildcards: asdict(run_spec(STUDY, STRAIGHT, 0.0)),
        analysis=config["analysis"],
    script:
        "scripts/heat.py"
