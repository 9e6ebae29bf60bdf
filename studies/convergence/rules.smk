# How accurate runs are, and what that costs. How much decides at the peaks of some coatings: the width of the coating's
# bars, the number of interface nodes; on the rigid casing the modes, the step and the law of impact. Not in `all`.

PEAKS_AGAIN = {"peaks": rules.peaks.output[0]}
SIMULATED = ("contact", "casings", "coatings", "speeds", "solver", "analysis")
# Modules, minutes to ask a cluster for, inputs and params
CONVERGENCE = {
    "finer_bars": (["extras.verification.refinement"], 5, PEAKS_AGAIN, {}),
    "more_nodes": (["extras.verification.refinement"], 10, PEAKS_AGAIN, {}),
    "rigid_convergence": (["extras.verification.rigid_casing"], 15, PEAKS_AGAIN, {}),
    # how accurate the study's runs are: a table of what `bladerub verify` measures
    "accuracy": (
        ["extras.verification.verify"],
        30,
        {"maps": expand(rules.coating.output.map, coating=COATINGS)},
        {"peaks": PEAKS},
    ),
    # what a run costs at several tolerances of its step, and what its error is then
    "steps": (
        ["extras.verification.steps"],
        20,
        {},
        {"dpi": DPI, "simulated": {key: config[key] for key in SIMULATED}},
    ),
}
for table, (modules, first_minutes, inputs, settings) in CONVERGENCE.items():

    rule:
        name:
            table
        input:
            **inputs,
            blade=rules.blade.output.reduced_model,
            kernel=rules.compile_kernel.output[0],
            analysing=files_behind(*modules),
        output:
            **described(table=f"{TABLES}/{table}.csv"),
            **(drawn(table) if table == "steps" else {}),
        log:
            f"{RESULTS}/logs/{table}.log",
        resources:
            runtime=minutes(first_minutes),
        params:
            **settings,
        script:
            "scripts/convergence.py"


PICTURES["steps_image"] = {"studies/convergence/images/steps.png": Picture(rules.steps.output.png, 24)}
