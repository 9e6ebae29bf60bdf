# A rigid tip on a coated disk, pass by pass (config/rigs.yaml). Not part of `all`.
from bladerub import plugins
from bladerub.extras.rig.spec import PLAN as RIGS


rule rigs:
    input:
        rigs=RIGS.as_posix(),
        code=files_behind("extras.rig.passes", "extras.plots.studies", *plugins.offered("LAWS").values()),
    output:
        **drawn("rigs", "Model", with_data=True),
        **described(table=f"{TABLES}/rigs.csv"),
    log:
        f"{RESULTS}/logs/rigs.log",
    params:
        dpi=DPI,
    script:
        "scripts/rigs.py"


PICTURES["rigs_image"] = {"docs/images/rigs.png": Picture(rules.rigs.output.png, 12, 2)}
