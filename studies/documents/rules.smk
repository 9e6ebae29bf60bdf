# What the pages are made from, all committed: reference of the config and its schema, tables that pages quote. Not part
# of `all`.
from pathlib import Path

from bladerub.io.folders import CONFIG


rule config_reference:
    input:
        config="config/config.yaml",
        settings=[path.relative_to(ROOT).as_posix() for path in ROOT.glob("src/bladerub/**/*settings.py")],
        page="docs/config_keys.py",
        writing=files_behind("config.keys", "settings.study"),
    output:
        reference=update("docs/config.md"),
        schema="config/schema.json",
    log:
        f"{RESULTS}/logs/config_reference.log",
    script:
        "scripts/config_reference.py"


def study_of_the_paper(wildcards):
    """All that the default target makes, with the config of the paper: pages quote no other study."""
    others = [file for file in LAID_OVER.files if Path(file).absolute() != CONFIG.absolute()]
    with bladerub.io.errors.exit_on_error():
        if others := [*others, *LAID_OVER.command_line]:
            raise bladerub.io.errors.BadInput(
                f"docs_data: with {', '.join(others)}; pages quote the study of the paper"
            )
    return rules.all.input  # which is read after this file


# Without an output: it takes snapshots anew whenever it is asked for, those of the pages of studies/ as well
rule docs_data:
    input:
        study_of_the_paper,
    log:
        f"{RESULTS}/logs/docs_data.log",
    params:
        results=RESULTS,
    script:
        "scripts/docs_data.py"
