"""A blade from a mesh or a table of sections, ``blade.source.file`` (`bladerub.blade.source`)."""

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from bladerub.blade import geometry
from bladerub.blade.model import n_interface
from bladerub.extras.blades import deck, origin
from bladerub.extras.blades.settings import Source
from bladerub.io.checksum import file_checksum
from bladerub.io.folders import study_folder
from bladerub.settings.blade import Blade
from bladerub.settings.study import Config

if TYPE_CHECKING:  # import the solver, which a plan does without
    from bladerub.blade.built import BuiltBlade
    from bladerub.blade.mesh import MeshedBlade


def problems(config: Config) -> Iterator[str]:
    """Yield a line for each thing in `config` that cannot be; raises ValueError as `geometry.check_size`."""
    source = config.blade.source
    yield from (wrong := [*origin.problems(source, files)])
    if origin.is_table(source) and not wrong:
        geometry.check_size(config.blade.mesh)
        geometry.check_interface(config.blade.mesh, n_interface(config))


def recipe(blade: Blade) -> dict[str, Any]:
    """Reduce the block ``blade`` to what determines the blade, with the content of its file."""
    source, values = blade.source, blade.plain()
    parts = ("material", "length", *(("mesh",) if origin.is_table(source) else ()))
    main, *included = [file_checksum(study_folder() / path) for path in files(source)]
    content = [main, *included] if included else main
    return {name: values[name] for name in parts} | {"source": origin.settings(source) | {"file": content}}


def files(source: Source) -> list[str]:
    """List the file of the block ``source`` and those that it includes; ValueError if one is missing."""
    path, folder = origin.path(source), os.path.dirname(source.file)
    included = deck.included(path) if path.suffix.lower() == ".inp" and path.is_file() else ()
    return [os.path.join(folder, name) for name in (path.name, *included)]


def meshed(blade: Blade, n_nodes: int) -> "MeshedBlade":
    """Read the blade, and mesh a table; BadInput if it cannot be used."""
    from bladerub.extras.blades.importing import import_blade

    return import_blade(blade.source, blade.mesh, n_nodes).blade


def build(config: Config) -> "BuiltBlade":
    """Build the blade, or read it where ``bladerub import`` kept it."""
    from bladerub.blade.build import meshed_blade, reduce_meshed
    from bladerub.extras.blades.importing import kept

    return kept(config) or reduce_meshed(meshed_blade(config.blade, n_interface(config)), config)
