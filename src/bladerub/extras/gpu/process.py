"""The process that has the GPU while Snakemake is at work."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bladerub.extras.gpu import ADDRESS  # without the solver: every call of snakemake comes here


def start_server() -> None:
    """Start `bladerub.extras.gpu.server` for the jobs of this process, with which it ends.

    One that the environment names already is used as it is.

    Without a GPU this process ends.
    """
    if os.environ.get(ADDRESS):
        return
    address = Path(tempfile.mkdtemp(prefix="bladerub-gpu-")) / "socket"
    server = subprocess.Popen(
        [sys.executable, "-m", "bladerub.extras.gpu.server", str(address)],
        stdin=subprocess.PIPE,  # ends with this process, however that ends, and the server with it
        start_new_session=True,  # Ctrl-C is for Snakemake, whose jobs may end theirs
    )
    while not address.exists():
        if server.poll() is not None:
            raise SystemExit(server.returncode)  # it has said why
        time.sleep(0.05)
    os.environ[ADDRESS] = str(address)
    _servers.append(server)


_servers: list[subprocess.Popen] = []  # keeps their input open
