"""The column ``variant`` of tables, if a coating has values of its own (`bladerub.study.grid.OWN`)."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from bladerub.study.grid import CoatingCase

if TYPE_CHECKING:
    import pandas as pd


def with_variant(table: "pd.DataFrame", columns: Sequence[str], *further: str) -> "pd.DataFrame":
    """Return these columns of `table`, and of the `further` ones and ``variant`` those that are not empty."""
    return table[[*columns, *(name for name in (*further, "variant") if table[name].any())]]


def plain(table: "pd.DataFrame") -> "pd.DataFrame":
    """Return the rows that are of no variant, without the column."""
    return filled(table).query("variant == ''").drop(columns="variant")


def of_case(table: "pd.DataFrame", case: CoatingCase) -> "pd.DataFrame":
    """Return the rows of one coating."""
    about = asdict(case)
    return table[(filled(table)[list(about)] == list(about.values())).all(axis=1)]


def filled(table: "pd.DataFrame") -> "pd.DataFrame":
    """Return `table` with the column, as text: an empty cell of a file is read as NaN."""
    return table.assign(variant=table["variant"].fillna("") if "variant" in table else "")
