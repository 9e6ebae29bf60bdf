"""What a person sees of the interface: objects in a terminal or a notebook, and how far a call has come."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from html import escape
from typing import Any

from tqdm.auto import tqdm


class Shown(ABC):
    """Shows itself by what a person asks of it first: a title, and names with values."""

    @abstractmethod
    def _shown(self) -> tuple[str, Mapping[str, str]]:
        """Return title and rows."""

    def __repr__(self) -> str:
        title, rows = self._shown()
        width = max(map(len, rows))
        return "\n".join([title, *(f"  {name:<{width}}  {value}" for name, value in rows.items())])

    def _repr_html_(self) -> str:
        title, rows = self._shown()
        cells = "".join(
            f"<tr><th style='text-align:left'>{escape(name)}</th>"
            f"<td style='text-align:left'>{escape(value)}</td></tr>"
            for name, value in rows.items()
        )
        return f"<table><caption>{escape(title)}</caption>{cells}</table>"


def bar(total: int, unit: str, progress: bool | None, **settings: Any) -> tqdm:
    """Return a bar of so many units on standard error, which goes when they are done.

    `progress` is None, for a terminal or notebook alone, or whether to show it; others are those of tqdm.
    """
    disable = None if progress is None else not progress
    return tqdm(total=total, unit=unit, disable=disable, leave=False, **settings)


@contextmanager
def step(text: str, progress: bool | None) -> Iterator[None]:
    """Show what is being done until it is done."""
    with bar(1, "", progress, desc=f"{text} …", bar_format="{desc}"):
        yield
