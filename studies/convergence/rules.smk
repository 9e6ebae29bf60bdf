# How much the width of the coating's bars decides at the peaks of some coatings. Not part of `all`.


rule finer_bars:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        peaks=rules.peaks.output[0],
        analysing=files_behind("extras.verification.refinement"),
    output:
        **described(table=f"{TABLES}/finer_bars.csv"),
    log:
        f"{RESULTS}/logs/finer_bars.log",
    benchmark:
        f"{RESULTS}/benchmarks/finer_bars.tsv"
    group:
        "drawing"
    resources:
        runtime=minutes(5),
    script:
        "scripts/finer_bars.py"


# How much the number of interface nodes decides at the same peaks
rule more_nodes:
    input:
        kernel=rules.compile_kernel.output[0],
        peaks=rules.peaks.output[0],
        analysing=files_behind("extras.verification.refinement"),
    output:
        **described(table=f"{TABLES}/more_nodes.csv"),
    log:
        f"{RESULTS}/logs/more_nodes.log",
    benchmark:
        f"{RESULTS}/benchmarks/more_nodes.tsv"
    group:
        "drawing"
    resources:
        mem_mb=memory_mb,
        runtime=minutes(10),
    script:
        "scripts/more_nodes.py"


# What the vibration on the rigid casing converges to, whatever the modes, the step and the law of impact
rule rigid_convergence:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        peaks=rules.peaks.output[0],
        analysing=files_behind("extras.verification.rigid_casing"),
    output:
        **described(table=f"{TABLES}/rigid_convergence.csv"),
    log:
        f"{RESULTS}/logs/rigid_convergence.log",
    benchmark:
        f"{RESULTS}/benchmarks/rigid_convergence.tsv"
    group:
        "drawing"
    resources:
        runtime=minutes(15),
    script:
        "scripts/rigid_convergence.py"


# How accurate the study's runs are: a table of what `bladerub verify` measures
rule accuracy:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        maps=expand(rules.coating.output.map, coating=COATINGS),
        analysing=files_behind("extras.verification.accuracy"),
    output:
        **described(table=f"{TABLES}/accuracy.csv"),
    log:
        f"{RESULTS}/logs/accuracy.log",
    benchmark:
        f"{RESULTS}/benchmarks/accuracy.tsv"
    resources:
        runtime=minutes(30),
    script:
        "scripts/accuracy.py"


# What a run costs at several tolerances of its step, and what its error is then
rule steps:
    input:
        blade=rules.blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        analysing=files_behind("extras.verification.steps"),
        drawing=files_behind("extras.plots.steps"),
    output:
        **described(table=f"{TABLES}/steps.csv"),
        png=f"{PLOTS}/steps.png",
        pdf=f"{PLOTS}/steps.pdf",
    log:
        f"{RESULTS}/logs/steps.log",
    benchmark:
        f"{RESULTS}/benchmarks/steps.tsv"
    resources:
        runtime=minutes(20),
    params:
        dpi=DPI,
    script:
        "scripts/steps.py"


use rule images as steps_image with:
    input:
        rules.steps.output.png,
    output:
        "studies/convergence/images/steps.png",
    log:
        f"{RESULTS}/logs/steps_image.log",
    params:
        colours=24,
