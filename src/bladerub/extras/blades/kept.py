"""Imported blades that are kept for their study, in the cache of this user."""

from contextlib import suppress

from bladerub.blade import built
from bladerub.blade.built import BuiltBlade
from bladerub.blade.cache import kept_at
from bladerub.blade.files import is_built
from bladerub.extras.blade_meshes import read_built
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config


def keep(blade: BuiltBlade, config: Config) -> None:
    """Keep the blade of `config` for its study, which builds it itself where it cannot be written."""
    with suppress(OSError):
        built.write(blade, provenance(config.plain()), kept_at(config))


def kept(config: Config) -> BuiltBlade | None:
    """Read the blade of `config` as it is kept; None if it is not, or damaged. Raises as `kept_at`."""
    with suppress(OSError):
        path = kept_at(config)
        if is_built(config, path):
            return read_built(path)
    return None
