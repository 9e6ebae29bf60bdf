"""Columns that the table of a study adds to one of the core, for what shows both."""

from pathlib import Path

import pandas as pd

from bladerub.io import tables


def with_further(table: pd.DataFrame, path: str | Path) -> pd.DataFrame:
    """Return `table` with the further columns of that at `path`, NaN in rows that are not there.

    Rows are the same if they agree in all columns of both. Without the file `table` is returned as it is.
    """
    if not Path(path).exists():
        return table
    further = tables.read(path)
    return table.merge(further, "left", on=[name for name in table if name in further])
