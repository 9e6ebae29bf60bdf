"""Ctrl-C in a job that has just started: Python ends without a traceback, as with one in its script.

A script handles errors from its first line on (`bladerub.workflow.job`). Before it Python starts and imports
Snakemake, for half a second. Python executes this module then (`site`), since its folder is in the
``PYTHONPATH`` of all jobs (`bladerub.extras.remedies.snakemake`). It imports nothing that takes time, since
Python does not start at all if it is interrupted here.
"""

import sys
from importlib.machinery import PathFinder

HERE = __file__.removesuffix("/sitecustomize.py")


def _report(kind: type[BaseException], error: BaseException, trace: object) -> None:
    if not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _report

# The environment may have a module of this name as well, which this one hides
others = PathFinder.find_spec("sitecustomize", [path for path in sys.path if path != HERE])
if others and others.loader:
    others.loader.exec_module(type(sys)("sitecustomize"))
