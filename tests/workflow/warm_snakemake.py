"""Serves calls of snakemake from a process that has its imports done, most of the time of a call.

Each line of standard input asks for one, in JSON (arguments of `_answer`). A fork answers it as a fresh
``snakemake`` would, importing this package from the sources that the environment of the call names; the line
written back is its exit code.
"""

import gc
import json
import os
import signal
import sys
from importlib import import_module

PACKAGES = (
    *("snakemake.cli", "snakemake_executor_plugin_slurm", "jinja2", "pydantic", "h5py", "pandas", "numba"),
    *("scipy.interpolate", "scipy.io", "scipy.linalg", "scipy.ndimage", "skfem.models", "rslab", "meshio"),
    *("snakemake.profiles", "snakemake.report.html_reporter", "snakemake.storage", "argparse_dataclass"),
    *("docutils.core", "dpath", "nbformat.v4", "PIL.Image", "platformdirs", "requests", "smart_open", "yte"),
)
LONGEST = 600
"""Of a call, s; it ends by SIGALRM."""


def main() -> None:
    for name in PACKAGES:
        import_module(name)
    if own := [name for name in sys.modules if name.partition(".")[0] == "bladerub"]:
        raise RuntimeError(f"{own[0]} is imported; must be left to each call")
    gc.freeze()  # what is imported is not looked at again and again in each fork
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            _answer(**json.loads(line))
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


def _answer(folder: str, environment: dict[str, str], arguments: list[str], stdout: str, stderr: str) -> None:
    signal.alarm(LONGEST)
    for descriptor, file, mode in ((0, os.devnull, "r"), (1, stdout, "w"), (2, stderr, "w")):
        with open(file, mode) as stream:
            os.dup2(stream.fileno(), descriptor)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.path[:0] = environment["PYTHONPATH"].split(os.pathsep)
    sys.argv = arguments
    sys.exit(sys.modules["snakemake.cli"].main())


if __name__ == "__main__":
    main()
