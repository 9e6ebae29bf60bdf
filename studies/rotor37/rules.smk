# Reference numbers of NASA Rotor 37, beside the study at work (studies/rotor37/README.md). Not part of `all`.
from functools import cache

from bladerub.study.grid import coating_cases

ROTOR37 = f"{RESULTS}/rotor37"
REFERENCE_BLADE = f"{ROTOR37}/reference/blade/reduced_model.h5"
REFERENCE_TABLES = ["blade", "direct", "interaction", "coatings"]
ROTOR37_FIGURES = [
    "response",
    "direct",
    "spectrum_rigid",
    "spectrum_coated",
    "wear_straight",
    "wear_inclined",
]


@cache
def rotor37_plan():
    """The config of every set; read only when somebody asks for Rotor 37."""
    from bladerub.extras.rotor37.reference import plan

    with bladerub.io.errors.exit_on_error():
        return plan()


def rotor37_numbers(wildcards):
    return [
        f"{ROTOR37}/{name}/numbers/{part}.csv"
        for name, own in rotor37_plan().items()
        for part in ["blade", *(case.name for case in coating_cases(own))]
    ]


def rotor37_set(wildcards):
    """The config of one set, by default the reference, plain: a changed one is a reason to run."""
    return rotor37_plan()[wildcards.get("set", "reference")].plain()


# By an integrator of its own: also a check of the numbers of direct contact
rule rotor37_independent:
    input:
        blade=REFERENCE_BLADE,
        computing=files_behind("extras.rotor37.direct"),
    output:
        **described(table=f"{ROTOR37}/independent.csv"),
    log:
        f"{RESULTS}/logs/rotor37_independent.log",
    resources:
        runtime=minutes(10),
    params:
        config=rotor37_set,
    script:
        "scripts/rotor37_checks.py"


def nlstep_program(wildcards):
    from bladerub.extras.rotor37.nlstep import program

    with bladerub.io.errors.exit_on_error():
        return str(program())


# Only where NLstep is: BLADERUB_NLSTEP=FOLDER snakemake -j2 rotor37_nlstep
rule rotor37_nlstep:
    input:
        blade=REFERENCE_BLADE,
        computing=files_behind("extras.rotor37.nlstep"),
        octave=[f"src/bladerub/extras/rotor37/octave/{name}.m" for name in ("CMS_ROM", "direct_contact")],
        program=nlstep_program,
    output:
        **described(table=f"{ROTOR37}/nlstep.csv"),
    log:
        f"{RESULTS}/logs/rotor37_nlstep.log",
    threads: 2
    resources:
        runtime=minutes(60),
    params:
        config=rotor37_set,
    script:
        "scripts/rotor37_checks.py"


rule rotor37:
    input:
        numbers=rotor37_numbers,
        drawing=files_behind(
            "extras.rotor37.figures",
            "extras.rotor37.reference",
            "plots.maps",
        ),
        independent=rules.rotor37_independent.output.table,  # a table beside those of this job
    output:
        **described(
            history=f"{ROTOR37}/direct_history.csv",
            **{name: f"{ROTOR37}/{name}.csv" for name in REFERENCE_TABLES},
        ),
        png=[f"{ROTOR37}/figures/{name}.png" for name in ROTOR37_FIGURES],
        pdf=[f"{ROTOR37}/figures/{name}.pdf" for name in ROTOR37_FIGURES],
    log:
        f"{RESULTS}/logs/rotor37.log",
    params:
        dpi=DPI,
        folder=ROTOR37,
        plan=lambda wildcards: {name: own.plain() for name, own in rotor37_plan().items()},
    script:
        "scripts/rotor37.py"


use rule blade as rotor37_blade with:
    input:
        code=files_behind("blade.build", "extras.blades.file_source"),
        given="config/blades/rotor37.csv",
    output:
        **described(rom_accuracy=f"{ROTOR37}/{{set}}/blade/rom_accuracy.csv"),
        reduced_model=f"{ROTOR37}/{{set}}/blade/reduced_model.h5",
        mesh=f"{ROTOR37}/{{set}}/blade/mesh.h5",
    log:
        f"{RESULTS}/logs/rotor37_blade/{{set}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/rotor37_blade/{{set}}.tsv"
    params:
        blade=lambda wildcards: rotor37_set(wildcards)["blade"],
        reduction=lambda wildcards: rotor37_set(wildcards)["reduction"],


rule rotor37_direct:
    input:
        blade=rules.rotor37_blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        measuring=files_behind("extras.rotor37.direct"),
    output:
        **described(
            blade=f"{ROTOR37}/{{set}}/numbers/blade.csv",
            direct=f"{ROTOR37}/{{set}}/numbers/direct.csv",
            history=f"{ROTOR37}/{{set}}/history.csv",
        ),
    log:
        f"{RESULTS}/logs/rotor37_direct/{{set}}.log",
    resources:
        runtime=minutes(5),
    params:
        config=rotor37_set,
    script:
        "scripts/rotor37_direct.py"


rule rotor37_coating:
    input:
        blade=rules.rotor37_blade.output.reduced_model,
        kernel=rules.compile_kernel.output[0],
        measuring=files_behind("extras.rotor37.numbers", "extras.small_study"),
    output:
        **described(numbers=f"{ROTOR37}/{{set}}/numbers/{{coating}}.csv"),
    log:
        f"{RESULTS}/logs/rotor37_coating/{{set}}/{{coating}}.log",
    resources:
        runtime=minutes(10),
    params:
        config=rotor37_set,
        folder=f"{ROTOR37}/{{set}}",
    script:
        "scripts/rotor37_coating.py"


PICTURES["rotor37_images"] = {
    f"studies/rotor37/images/rotor37_{name}.png": Picture(f"{ROTOR37}/figures/{name}.png", 48)
    for name in ("response", "direct", "spectrum_coated", "wear_straight")
}


# The reference numbers of the repository, once they are computed anew
rule rotor37_reference:
    input:
        rules.rotor37_independent.output.table,
        [rules.rotor37.output[name] for name in [*REFERENCE_TABLES, "history"]],
    log:
        f"{RESULTS}/logs/rotor37_reference.log",
    script:
        "scripts/rotor37_reference.py"


use rule rotor37_reference as rotor37_nlstep_reference with:
    input:
        rules.rotor37_nlstep.output.table,
    log:
        f"{RESULTS}/logs/rotor37_nlstep_reference.log",
