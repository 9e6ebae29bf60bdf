"""What shows on standard error how far a call has come.

`progress` is None, for a terminal or notebook alone, or whether to show it.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from tqdm.auto import tqdm


def bar(total: int, unit: str, progress: bool | None, **look: str) -> tqdm:
    """Return a bar of so many units, which goes when they are done."""
    disable = None if progress is None else not progress
    return tqdm(total=total, unit=unit, disable=disable, leave=False, **look)


@contextmanager
def step(text: str, progress: bool | None) -> Iterator[None]:
    """Show what is being done until it is done."""
    with bar(1, "", progress, desc=f"{text} …", bar_format="{desc}"):
        yield
