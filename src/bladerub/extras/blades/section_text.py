"""Tables of blade sections as text: which file is one, and the columns that it must name.

Nothing here takes time to import, so that a wrong table is refused at once.
"""

import re
from itertools import islice
from pathlib import Path

from bladerub.extras import cells
from bladerub.extras.blades import origin
from bladerub.extras.cells import Cells

POINTS = ("x1", "y1", "z1", "x2", "y2", "z2")
CYLINDRICAL = ("z", "r", "theta1", "theta2")
_LOOKED_THROUGH = 50  # lines, for names below a title


def read(path: Path) -> tuple[Cells, tuple[str, ...]]:
    """Read a table and the columns of numbers of its form.

    A ValueError names the line or says what is no table of sections.
    """
    origin.check_file(path)
    table = cells.read(path)
    try:
        form = _form({name.lower() for name in table.names})
    except ValueError as error:
        what = f"line {table.header} must name the columns; cells separated by {table.separator}"
        first = " ".join(table.names)[:60]
        raise ValueError(f'{error} ({what}: "{first}"{_likely_names(table)})') from error
    for name in ("section", *form):
        table.column(name)
    return table, form


def _likely_names(table: Cells) -> str:
    """Point out a line below the first that seems to name the columns, as in files with a title."""
    for line, row in islice(table.rows.items(), _LOOKED_THROUGH):
        text = " ".join(row)
        words = re.sub(r"(?<=[a-z]) (?=[12]\b)", "", re.sub("[,;]", " ", text.lower())).split()
        if any(len(set(form).intersection(words)) >= len(form) - 1 for form in (POINTS, CYLINDRICAL)):
            return f', and not line {line}: "{text[:60]}"'
    return ""


def _form(columns: set[str]) -> tuple[str, ...]:
    """Choose the form that `columns` belong to."""
    forms = [form for form in (POINTS, CYLINDRICAL) if columns.issuperset(form)]
    if len(forms) == 1 and "section" in columns:
        return forms[0]
    both = f"section, {', '.join(POINTS)} or section, {', '.join(CYLINDRICAL)}"
    if len(forms) == 2:
        raise ValueError(f"has the columns of both forms; must have either {both}")
    bare = {re.split(r"\s*[\[(]", column)[0] for column in columns}
    if not forms and any(bare.issuperset(form) for form in (POINTS, CYLINDRICAL)):
        raise ValueError("has units behind the names of its columns; give them as unit and angle_unit")
    closest = max((POINTS, CYLINDRICAL), key=lambda form: len(columns.intersection(form)))
    form = ("section", *(forms[0] if forms else closest))
    missing = [name for name in form if name not in columns]
    requirement = ", ".join(form) if len(missing) < len(form) else both
    raise ValueError(f"has no column {', '.join(missing)}; must have {requirement}")
