# Coulomb friction compared with a contact force of constant direction, on the coatings listed for it. Not part of `all`.
from bladerub.extras.friction.coatings import compared

COMPARED = [case.name for case in compared(STUDY)]


rule friction:
    input:
        blade=rules.blade.output.reduced_model,
        manifests=expand(rules.coating.output.manifest, coating=COMPARED),
        code=files_behind("extras.friction.table", "extras.plots.studies", "study.summary"),
    output:
        **drawn("friction", "Angle of the elements"),
        **described(table=f"{TABLES}/friction.csv"),
    log:
        f"{RESULTS}/logs/friction.log",
    group:
        "drawing"
    params:
        revolutions=config["analysis"]["spectrum_revolutions"],
        dpi=DPI,
    script:
        "scripts/friction.py"
