# A rigid tip on a coated disk, pass by pass (config/rigs.yaml). Not part of `all`.
from bladerub import plugins
from bladerub.extras.rig.spec import PLAN as RIGS


rule rigs:
    input:
        rigs=RIGS.as_posix(),
        laws=files_behind(*plugins.offered("LAWS").values()),
        computing=files_behind("extras.rig.passes"),
        drawing=files_behind("extras.plots.rigs"),
    output:
        **drawn("rigs", "Model", with_data=True),
        **described(table=f"{TABLES}/rigs.csv"),
    log:
        f"{RESULTS}/logs/rigs.log",
    benchmark:
        f"{RESULTS}/benchmarks/rigs.tsv"
    params:
        dpi=DPI,
    script:
        "scripts/rigs.py"


use rule images as rigs_image with:
    input:
        rules.rigs.output.png,
    output:
        "docs/images/rigs.png",
    log:
        f"{RESULTS}/logs/rigs_image.log",
    params:
        colours=12,
        shrink=2,
