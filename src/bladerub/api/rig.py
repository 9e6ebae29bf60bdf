"""A rub rig: a rigid blade tip that is fed into a coated disk."""

import pandas as pd

from bladerub.extensions.rig.passes import simulate_passes
from bladerub.extensions.rig.spec import Rig


def simulate_rig(rig: Rig) -> pd.DataFrame:
    """Simulate the passes of a rub rig.

    Parameters
    ----------
    rig : Rig
        Tip, coated disk and incursion.

    Returns
    -------
    DataFrame
        A row for each pass, SI units: see ``results/tables/rigs.csv`` in the reference of the tables.

    Raises
    ------
    ValueError
        If a parameter of the law is out of its range.

    Examples
    --------
    >>> import bladerub as br
    >>> rig = br.Rig(
    ...     "mine", E=600e6, K=300e6, yield_stress=0.0, thickness=3e-3, tip_width=1e-2, tip_length=2e-3,
    ...     track=1.0, speed=125.0, incursion=1e-5, passes=3,
    ... )
    >>> passes = br.simulate_rig(rig)
    >>> (passes.worn_depth * 1e6).round(2).tolist()  # µm
    [6.67, 13.33, 20.0]
    """
    return simulate_passes(rig)
