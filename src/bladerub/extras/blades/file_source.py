"""A blade from a mesh or a table of sections, ``blade.source.file`` (`bladerub.blade.source`)."""

import os
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from bladerub.blade import geometry
from bladerub.blade.model import n_interface
from bladerub.extras.blades import deck, origin
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.settings import Source
from bladerub.io.checksum import file_checksum
from bladerub.io.errors import format_value
from bladerub.settings.blade import Blade
from bladerub.settings.study import Config

if TYPE_CHECKING:  # import the solver, which a plan does without
    from bladerub.blade.built import BuiltBlade
    from bladerub.blade.mesh import MeshedBlade


def problems(config: Config) -> Iterator[str]:
    """Yield a line for each thing in `config` that cannot be; raises ValueError as `geometry.check_size`."""
    blade = config.blade
    try:
        source = origin.read(blade.source)
    except ValueError as error:
        yield f"blade.source.{error}"
        return
    if not source.file.is_file():
        setting = f"blade.source.file = {format_value(blade.source.file)}"
        yield f"{setting}: there is no such file ({source.file})"
    try:
        files(blade.source)
    except ValueError as error:
        yield f"blade.source.file = {format_value(blade.source.file)}: {error}"
    if source.is_table:
        geometry.check_size(blade.mesh)
        geometry.check_interface(blade.mesh, n_interface(config))


def recipe(blade: Blade) -> dict[str, Any]:
    """Reduce the block ``blade`` to what determines the blade, with the content of its file."""
    source, values = origin.read(blade.source), blade.plain()
    parts = ("material", "length", *(("mesh",) if source.is_table else ()))
    settings = asdict(Frame()) | values["source"]  # what a config leaves out is not another blade
    main, *included = [file_checksum(source.file.parent / name) for name in _names(source)]
    content = [main, *included] if included else main
    return {name: values[name] for name in parts} | {"source": settings | {"file": content}}


def files(source: Source) -> list[str]:
    """List the file of the block ``source`` and those that it includes; ValueError if one is missing."""
    folder = os.path.dirname(source.file)
    return [os.path.join(folder, name) for name in _names(origin.read(source))]


def _names(source: origin.Source) -> list[str]:
    """Name the file and those that it includes, relative to its folder."""
    is_deck = source.file.suffix.lower() == ".inp" and source.file.is_file()
    return [source.file.name, *(deck.included(source.file) if is_deck else ())]


def meshed(blade: Blade, n_nodes: int) -> "MeshedBlade":
    """Read the blade, and mesh a table; BadInput if it cannot be used, or is not of the length in `blade`."""
    from bladerub.extras.blades.importing import check_length, import_blade

    imported = import_blade(origin.read(blade.source), blade.mesh, n_nodes).blade
    check_length(blade.length, imported.length, blade.source.file)
    return imported


def build(config: Config) -> "BuiltBlade":
    """Build the blade, or read it where ``bladerub import`` kept it."""
    from bladerub.blade.build import meshed_blade, reduce_meshed
    from bladerub.extras.blades.kept import kept

    return kept(config) or reduce_meshed(meshed_blade(config.blade, n_interface(config)), config)


def frequency_at_rest(config: Config) -> float:
    """Compute the first frequency at rest, Hz; raises as `meshed`."""
    from bladerub.blade.build import frequency_of_mesh, meshed_blade

    return frequency_of_mesh(meshed_blade(config.blade, n_interface(config)), config)
