# The blade of a config compared with that of the study, which is finished in results/: the figures of both, and what
# the coatings show that both have, at their common speeds. Not part of `all`.
from bladerub.study.grid import coating_cases

REFERENCE = "results"


def common_maps(wildcards):
    """Maps of the coatings that the reference has too, first all of this study, then all of the reference."""
    names = [case.name for case in coating_cases(STUDY) if Path(f"{REFERENCE}/maps/{case.name}.h5").exists()]
    return [f"{folder}/maps/{name}.h5" for folder in (RESULTS, REFERENCE) for name in names]


rule blade_comparison:
    input:
        blade=rules.blade.output.reduced_model,
        mesh=rules.blade.output.mesh,
        reference=f"{REFERENCE}/blade/reduced_model.h5",
        maps=common_maps,
        analysing=files_behind("extras.blade_comparison"),
    output:
        **described(
            blades=f"{TABLES}/blade_comparison.csv",
            runs=f"{TABLES}/blade_comparison_runs.csv",
        ),
    log:
        f"{RESULTS}/logs/blade_comparison.log",
    script:
        "scripts/blade_comparison.py"
