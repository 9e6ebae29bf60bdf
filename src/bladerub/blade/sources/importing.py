"""One way in for blades from files of every kind."""

from __future__ import annotations

from collections.abc import Mapping

from bladerub.blade.sources.imported import Imported, import_mesh
from bladerub.blade.sources.origin import Source
from bladerub.blade.sources.section_blade import import_sections


def import_blade(source: Source, counts: Mapping[str, int]) -> Imported:
    """Read the mesh of `source`, or mesh its sections with the numbers of elements `counts`.

    Raises
    ------
    BadInput
        If the file cannot be used as a blade; the message names the file and the culprit.
    """
    return import_sections(source, counts) if source.is_table else import_mesh(source)
