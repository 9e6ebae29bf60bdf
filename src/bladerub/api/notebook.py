"""How objects show themselves, in a terminal and in a notebook."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from html import escape


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
