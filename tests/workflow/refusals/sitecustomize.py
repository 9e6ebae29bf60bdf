"""Let the system refuse to open files to read whose paths match ``REFUSED``, by the error ``REFUSAL``.

Python imports it at the start of every process that has this folder in ``PYTHONPATH``.
"""

import builtins
import io
import os
import re

import h5py

PATTERN, CODE = re.compile(os.environ["REFUSED"]), int(os.environ["REFUSAL"])


def _refusing(plain):
    def opened(path, mode="r", *arguments, **options):
        if (
            isinstance(path, str | os.PathLike)
            and PATTERN.search(os.fspath(path))
            and set(mode) <= set("rbt")
        ):
            raise OSError(CODE, os.strerror(CODE), os.fspath(path))
        return plain(path, mode, *arguments, **options)

    return opened


builtins.open = io.open = _refusing(open)
_open_hdf5 = h5py.File.__init__
h5py.File.__init__ = lambda self, *arguments, **options: _refusing(
    lambda path, mode, *rest, **more: _open_hdf5(self, path, mode, *rest, **more)
)(*arguments, **options)
