"""Record all numbers of the pages for review, and the table of claims in the README.

``python -m docs.numbers.record`` does so after a change in this folder, from the tables as they are.
"""

from docs.numbers import FOLDER, ROOT, Tables, numbers_of
from docs.numbers.claims import update_readme

VALUES = FOLDER / "values.txt"


def record() -> None:
    """Write what the tables say now into `VALUES` and ``README.md``."""
    tables = Tables()
    VALUES.write_text(values(tables), encoding="utf-8")
    update_readme(ROOT / "README.md", tables)


def values(tables: Tables) -> str:
    """Write each name of each page and its text."""
    lines = []
    for page in sorted(_pages()):
        lines.append(f"[{page}]")
        for name, text in numbers_of(page, tables).items():
            lines.append(f"{name} =\n{text}" if "\n" in text else f"{name} = {text}")
        lines.append("")
    return "\n".join(lines)


def _pages():
    """Name the pages that quote numbers, each by the module that makes them."""
    for module in (*FOLDER.glob("[!_]*.py"), *ROOT.glob("studies/**/numbers.py")):
        if "\ndef numbers(" in module.read_text(encoding="utf-8"):
            yield module.parent.name if module.parent != FOLDER else module.stem


if __name__ == "__main__":
    record()
