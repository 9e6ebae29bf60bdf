"""Studies beside that of the paper: those that are there, with all that they compute with."""

from pathlib import Path

from bladerub.io.sources import extras_behind
from bladerub.plugins import EXTRAS


def rules_of_studies(repository: Path) -> tuple[list[Path], list[str]]:
    """Return the rules of all studies in ``studies``, and a line for each that is left out.

    That is one whose rules, scripts or the modules that these import need a folder of `bladerub.extras` that
    was deleted.
    """
    present = {path.stem for path in EXTRAS.glob("*") if path.is_dir() or path.suffix == ".py"}
    complete, notes = [], []
    for rules in sorted(repository.glob("studies/*/rules.smk")):
        code = [path.read_text(encoding="utf-8") for path in (rules, *rules.parent.glob("scripts/*.py"))]
        if missing := sorted(extras_behind(*code) - present):
            needed = " and ".join(f"bladerub.extras.{name}" for name in missing)
            notes.append(f"without the study {rules.parent.name}, which needs {needed}")
        else:
            complete.append(rules)
    return complete, notes
