# The laws of the elements beside the paper's, drawn as Fig. 4 is. Not part of `all`.
from bladerub.contact.laws import NAMES


rule laws:
    input:
        model=files_behind("contact.illustration"),
        laws=files_behind(
            *(f"contact.laws.{name}" for name in NAMES if name != "plastic")
        ),
        drawing=files_behind("plots.law_cycles"),
    output:
        **drawn("laws", "Model", with_data=True),
    log:
        f"{RESULTS}/logs/laws.log",
    benchmark:
        f"{RESULTS}/benchmarks/laws.tsv"
    params:
        dpi=DPI,
        coating=part_of_run(STRAIGHT, "coating"),
    script:
        "../scripts/laws.py"
