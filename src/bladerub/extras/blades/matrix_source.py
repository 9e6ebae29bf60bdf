"""A blade from a folder of matrices, ``blade.source.matrices`` (`bladerub.blade.source`)."""

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from bladerub.extras.blades import matrix_folder, origin
from bladerub.extras.blades.settings import Source
from bladerub.io.checksum import file_checksum
from bladerub.settings.blade import Blade
from bladerub.settings.study import Config

if TYPE_CHECKING:  # imports the solver, which a plan does without
    from bladerub.blade.built import BuiltBlade


def problems(config: Config) -> Iterator[str]:
    """Yield a line for each thing in `config` that cannot be."""
    yield from origin.problems(config.blade.source, files)
    if (count := config.reduction.fit_speeds) not in (None, 3):
        yield f"reduction.fit_speeds = {count}: must be 3 with blade.source.matrices"


def recipe(blade: Blade) -> dict[str, Any]:
    """Reduce the block ``blade`` to what determines the blade, with the content of its files."""
    paths = matrix_folder.files(origin.path(blade.source))
    content = {name: file_checksum(path) for name, path in paths.items()}
    return {"length": blade.length, "source": origin.settings(blade.source) | {"matrices": content}}


def files(source: Source) -> list[str]:
    """List the files of the block ``source``; ValueError if one is missing."""
    paths = matrix_folder.files(origin.path(source)).values()
    return [os.path.join(source.matrices, path.name) for path in paths]


def build(config: Config) -> "BuiltBlade":
    """Build the blade, or read it where ``bladerub import`` kept it; BadInput if it is not of its length."""
    from bladerub.blade.build import reduce_given
    from bladerub.extras.blades.importing import kept
    from bladerub.extras.blades.matrices import of_length

    return kept(config) or reduce_given(of_length(config), config)


def frequency_at_rest(config: Config) -> float:
    """Compute the first frequency at rest, Hz; BadInput as `build`."""
    from bladerub.extras.blades.matrices import of_length

    return float(of_length(config).frequency[0])
