"""Where the blade of a config comes from if it is not parametric: ``blade.source``.

Each key of ``blade.source`` that names a place, such as a file, has a module of its own, which plugs in
(``SOURCES`` of `bladerub.plugins`). In the module are

============================= ==========================================================================
``problems(config)``          yields a line for each thing in `config` that cannot be
``recipe(blade)``             the block ``blade`` with all that determines the blade, and no more
``files(source)``             the files that the block ``source`` names, relative to the study
``meshed(blade, n_nodes)``    the meshed blade with `n_nodes` interface nodes, where there are elements
``build(config)``             the `bladerub.blade.built.BuiltBlade`
``frequency_at_rest(config)`` its first frequency at rest, Hz, where there are none
============================= ==========================================================================
"""

from types import ModuleType

from bladerub import plugins
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Blade, BladeSpec

FUNCTIONS = ("problems", "recipe", "files", "build")  # of every source; meshed or frequency_at_rest beside


def place(blade: Blade) -> str | None:
    """Name the module for the source of a block ``blade``, None if parametric; ValueError if none is."""
    source, places = blade.plugged("source"), plugins.offered("SOURCES")
    if source is None:
        return None
    keys = [key for key in places if source.plugged(key) is not None]
    if len(keys) == 1:
        return places[keys[0]]
    one = " or ".join(sorted(places)) or "a plugin that reads it"
    raise ValueError(f"blade.source: must have {one}{', not both' if keys else ''}")


def modules(config: BladeSpec) -> list[str]:
    """Name the modules, below ``bladerub``, that build the blade of `config`; raises as `place`."""
    refining = [] if config.reduction.tolerance is None else plugins.offered("REDUCTIONS").values()
    return ["blade.build", *filter(None, [place(config.blade)]), *refining]


def reader(blade: Blade) -> ModuleType | None:
    """Import what `place` names, if anything; raises `BadInput` if it lacks a function of a source."""
    name = place(blade)
    if name is None:
        return None
    module = plugins.load(name)
    needed = FUNCTIONS if hasattr(module, "meshed") else (*FUNCTIONS, "frequency_at_rest")
    if missing := [function for function in needed if not hasattr(module, function)]:
        raise BadInput(f"bladerub.{name}: has no {', '.join(missing)}; a source of blades must have them")
    return module


def files(blade: Blade) -> list[str]:
    """List the files that the block ``blade`` names; ValueError if one that is needed is missing."""
    module = reader(blade)
    return module.files(blade.plugged("source")) if module else []
