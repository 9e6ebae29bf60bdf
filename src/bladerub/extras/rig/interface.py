"""A rub rig: a blade tip, rigid or of an elastic blade, that is fed into a coated disk."""

import pandas as pd

from bladerub.api.arguments import InputError, over
from bladerub.api.blade import Blade
from bladerub.api.planned import checked_number
from bladerub.api.study import default_study
from bladerub.extras.rig.blade import simulate_blade_passes
from bladerub.extras.rig.passes import simulate_passes
from bladerub.extras.rig.spec import Rig


@over("rig")
def simulate_rig(
    rig: Rig, blade: Blade | None = None, damping_ratio: float | None = None, disk_turns: bool = False
) -> pd.DataFrame:
    """Simulate the passes of a rub rig.

    Parameters
    ----------
    rig : Rig
        Tip, coated disk and incursion; a list of rigs gives a list of tables.
    blade : Blade, optional
        An elastic blade in the place of the rigid tip. Width of the tip and length of the track are then its
        own, and the coated part of the track must leave room to feed it.
    damping_ratio : float, optional
        Damping of its modes; that of the default study if not given.
    disk_turns : bool
        Whether the disk turns instead of the blade, which then has its stiffness at rest.

    Returns
    -------
    DataFrame
        A row for each pass, SI units: see ``results/tables/rigs.csv`` in the reference of the tables. With a
        blade also ``largest_normal_force`` (N) and ``radial_amplitude`` of node 1 (m); forces are then means
        over the time that the coated part takes.

    Raises
    ------
    ValueError
        If a parameter of the law is out of its range, or the blade cannot be simulated in this rig: the
        message names the parameter, its value and what is right.

    Examples
    --------
    >>> import bladerub as br
    >>> rig = br.Rig(
    ...     "mine", E=600e6, K=300e6, yield_stress=0.0, thickness=3e-3, tip_width=1e-2, tip_length=2e-3,
    ...     track=1.0, speed=125.0, incursion=1e-5, passes=3, coated=0.05,
    ... )
    >>> passes = br.simulate_rig(rig)
    >>> (passes.worn_depth * 1e6).round(2).tolist()  # µm
    [6.67, 13.33, 20.0]

    An elastic blade yields in the first pass, and still vibrates when the next begins:

    >>> elastic = br.simulate_rig(rig, blade)
    >>> bool(elastic.worn_depth[0] < passes.worn_depth[0]), bool(elastic.energy_residual.max() < 1e-3)
    (True, True)
    """
    if not isinstance(rig, Rig):
        raise InputError("rig", rig, "must be a Rig")
    if blade is None:
        return simulate_passes(rig)
    if not isinstance(blade, Blade):
        raise InputError("blade", blade, "must be a Blade")
    config = default_study().config
    if damping_ratio is None:
        damping_ratio = config.contact.damping_ratio
    damping_ratio = checked_number(config, "damping_ratio", damping_ratio)
    return simulate_blade_passes(rig, blade.reduced, damping_ratio, disk_turns)
