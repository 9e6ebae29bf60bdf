"""Every command of the program on the tiny study, as a user gives it."""

import subprocess

from workspace import Workspace

COATING = "2nd_E1.1_K0.5_theta0"
RUN = ("run", "--casing", "2nd", "--E", "1.1", "--K", "0.5", "--f", "0.197", "--revolutions", "2")
ON_RESULTS = [
    ("bladerub", "status"),
    ("bladerub", "status", "--thorough"),
    ("bladerub", "status", "--thorough", "--discard"),
    ("bladerub", "verify", "--sample", "1", "--seed", "1"),
    ("bladerub", *RUN),
    ("bladerub", "export", "--animation", "a.gif", "--run", f"results/runs/{COATING}/0.1970.h5"),
    ("bladerub", "compare", "results/tables", "results/tables"),
    ("snakemake", "-j1", "--quiet", "all", "--dry-run"),
    ("snakemake", "-j1", "--quiet", "all", "--keep-going"),
    ("python", "-c", f"import bladerub as br; br.read_map('results/maps/{COATING}.h5')"),
]
"""Those that read what a study has computed."""
OTHERS = [
    ("bladerub", "new", "a study"),
    ("bladerub", "config", "overlay.yaml"),
    ("bladerub", "import", "config/blades/twisted_plate.inp"),
    ("bladerub", "import", "none.msh"),
    ("bladerub", "fit-coating", "none.csv"),
    ("bladerub", "check-law", "brittle", "--parameter", "break_strain=5e-3"),
    ("bladerub", "benchmark", "--rounds", "1", "--nodes", "8"),
    ("bladerub", "export", "--sections", "sections.csv"),
    ("snakemake", "-j1", "results/figures/fig02_campbell.png", "--force"),
]


def call(study: Workspace, command: tuple[str, ...], **environment: str) -> subprocess.CompletedProcess:
    """Give a command with the config of the study that was last built there."""
    name, *arguments = command
    if name == "snakemake":
        arguments += ["--configfile", "overlay.yaml"]
    elif name == "bladerub" and arguments[0] not in ("new", "config", "compare"):
        arguments += ["--config", "overlay.yaml"]
    return study.call(name, *arguments, **environment)
