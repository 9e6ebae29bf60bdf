"""The coating's law from measured stress-strain curves."""

from pathlib import Path

from bladerub.api.arguments import over
from bladerub.extras.fit import curves
from bladerub.extras.fit.fit import Fit, fit


@over("path")
def fit_coating(path: str | Path, *, strain_unit: str | None = None, stress_unit: str | None = None) -> Fit:
    """Fit E, K, the elastic limit and, over several rates, the overstress to compressive curves.

    Parameters
    ----------
    path : path
        Table in CSV with the columns ``strain``, ``stress`` and, for several rates, ``rate`` (1/s), a unit in
        brackets behind each: ``stress (MPa)``. A column ``test`` tells tests of one rate apart.
        A list of paths gives a list of fits.
    strain_unit : str, optional
        ``"1"`` or ``"%"``, where the header has none. Default: 1.
    stress_unit : str, optional
        ``"Pa"``, ``"kPa"``, ``"MPa"`` or ``"GPa"``, where the header has none.

    Returns
    -------
    Fit
        Parameters in Pa, with standard errors, intervals of 95 % and covariance.

    Raises
    ------
    BadInput
        If the table cannot be used: the message names column, line and value. A `ValueError`.

    Examples
    --------
    >>> import bladerub as br
    >>> rows = [f"{e / 1000},{min(900 * e / 1000, 9 + 50 * (e / 1000 - 0.01))}" for e in range(1, 41)]
    >>> with open("curve.csv", "w") as stream:
    ...     print("strain,stress (MPa)", *rows, sep=chr(10), file=stream)
    >>> fit = br.fit_coating("curve.csv")
    >>> round(fit["E"].value / 1e6), round(fit["yield_stress"].value / 1e6, 3), fit["K"].determined
    (900, 9.0, True)
    """
    return fit(curves.read(path, {"strain": strain_unit or "", "stress": stress_unit or ""}))
