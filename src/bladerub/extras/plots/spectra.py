"""The spectra of several runs in one picture."""

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, cast

from bladerub.api.arguments import InputError
from bladerub.api.run import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot_spectra(
    runs: Iterable[Run], path: str | Path | None = None, *, ax: "Axes | None" = None
) -> "Figure | Axes":
    """Draw the spectra of several runs in one picture; arguments as of `Run.plot_spectrum`.

    Its other plots draw several runs in one picture as well, if the same axes are given to each.

    Raises
    ------
    InputError
        If there is no run.

    Examples
    --------
    >>> import bladerub as br
    >>> stiffer = br.simulate(blade, study.run("2nd", E=4, K=0.5, f_omega=0.19, revolutions=3))
    >>> len(br.plot_spectra([run, stiffer]).axes[0].lines)
    2
    """
    if not isinstance(runs, Iterable) or not (runs := [*runs]):
        raise InputError("runs", runs, "must be a list of one Run or more")
    first, *others = runs
    picture = first.plot_spectrum(None if others else path, ax=ax)
    axes = cast("Figure", picture).axes[0] if ax is None else ax
    for run in others:
        run.plot_spectrum(path if run is others[-1] else None, ax=axes)
    return picture
