"""From the config to the reduced blade and the tables that say how good it is."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub import plugins
from bladerub.blade import geometry
from bladerub.blade.built import BuiltBlade
from bladerub.blade.discrete import DiscreteBlade, by_finite_elements
from bladerub.blade.mesh import BladeMesh, MeshedBlade, check_length
from bladerub.blade.model import N_INTERFACE, n_interface
from bladerub.blade.reduction import fit_speeds, reduce
from bladerub.blade.source import reader
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Blade, BladeSpec


def build(config: BladeSpec) -> BuiltBlade:
    """Build the blade of the ``blade`` and ``reduction`` blocks of `config`.

    Raises ValueError if the blade cannot be meshed, its subclass BadInput if it cannot be imported, is not of
    its length or ``reduction.tolerance`` is not reached, EquilibriumError if it has no static equilibrium.
    """
    if source := reader(config.blade):
        return source.build(config)
    return reduce_meshed(meshed_blade(config.blade, n_interface(config)), config)


def frequency_at_rest(config: BladeSpec) -> float:
    """Return the first frequency at rest (Hz) of the blade that `build` builds; raises the same."""
    source = reader(config.blade)
    if source and not hasattr(source, "meshed"):
        return source.frequency_at_rest(config)
    meshed = meshed_blade(config.blade, n_interface(config))
    return float(by_finite_elements(meshed, config.blade.material, (), (), 1).frequency[0])


def reduce_meshed(blade: MeshedBlade, config: BladeSpec) -> BuiltBlade:
    """Reduce a meshed blade with as many speeds and modes as its tolerance asks for; see `build`."""
    reduction = config.reduction
    table_speeds = np.linspace(0, reduction.f_omega_max, reduction.accuracy_speeds).tolist()

    @lru_cache(maxsize=1)  # more modes at each speed need no new equilibria
    def discrete(n_speeds: int) -> DiscreteBlade:
        speeds = fit_speeds(reduction.f_omega_max, n_speeds)
        return by_finite_elements(
            blade, config.blade.material, speeds, table_speeds, reduction.accuracy_modes
        )

    return _reduce(discrete, config)


def reduce_given(blade: DiscreteBlade, config: BladeSpec) -> BuiltBlade:
    """Reduce a blade of given matrices with as many modes as its tolerance asks for; see `build`."""
    return _reduce(lambda _: blade, config, len(blade.stiffness))


def _reduce(
    discrete: Callable[[int], DiscreteBlade], config: BladeSpec, most_fit_speeds: int | None = None
) -> BuiltBlade:
    """Reduce what `discrete` gives for a number of fit speeds; a tolerance asks for more (``REDUCTIONS``)."""
    if config.reduction.tolerance is None:
        return reduce(discrete(config.reduction.fit_speeds or 3), config)
    if "tolerance" not in (offered := plugins.offered("REDUCTIONS")):
        raise BadInput("reduction.tolerance: must be left out, this package does not refine a reduction")
    return plugins.load(offered["tolerance"]).reduce_to_tolerance(discrete, config, most_fit_speeds)


@threadpool_limits.wrap(limits=1)
def meshed_blade(blade: Blade, n_nodes: int = N_INTERFACE) -> MeshedBlade:
    """Mesh the block ``blade``, or its source, with `n_nodes` interface nodes; raises as `build`."""
    if source := reader(blade):
        if not hasattr(source, "meshed"):
            raise BadInput("blade.source: its blade has no finite elements, which this needs")
        meshed = source.meshed(blade, n_nodes)
        origin = next(iter(source.files(blade.plugged("source"))), "blade.source")
        check_length(blade.length, meshed.length, origin)
        return meshed
    geometry.check(blade, n_nodes)
    shape = geometry.BladeShape.from_config(blade)
    return MeshedBlade(BladeMesh.from_shape(shape, blade.mesh, n_nodes), shape.tip_cone)
