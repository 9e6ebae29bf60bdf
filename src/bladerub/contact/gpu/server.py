"""One process that has the GPU, for the jobs of a workflow: what they ask for runs side by side there.

Kernels of different processes take turns on a GPU, those of one process share it. So Snakemake's main process
starts this one, and each job sends its runs to it (`bladerub.workflow.gpu`).
"""

import contextlib
import os
import shutil
import sys
import threading
from multiprocessing.connection import Client, Connection, Listener
from pathlib import Path

from bladerub.contact.gpu import device, emulation
from bladerub.contact.gpu.batch import Device, Left, Work
from bladerub.io.errors import exit_on_error

ADDRESS = "BLADERUB_GPU"
"""Environment variable with the socket of the server."""


def find() -> Device:
    """Return what runs are to be given to: the server, if there is one, or the GPU itself."""
    return ask if os.environ.get(ADDRESS) else device.run


def ask(work: Work) -> Left:
    """Let the server carry out the loop for the runs of `work`.

    Raises `bladerub.contact.gpu.device.NoGpuError` if it does not answer, and what it raises.
    """
    address = os.environ[ADDRESS]
    try:
        with Client(address, "AF_UNIX") as connection:
            connection.send(work)
            answer = connection.recv()
    except (OSError, EOFError) as error:
        problem = f"the process that has the GPU does not answer at {address} ({error!r})"
        raise device.NoGpuError(f"{problem}; the same command goes on from what is finished") from error
    if isinstance(answer, Exception):
        raise answer
    return answer


def serve(address: str, run: Device) -> None:
    """Carry out what is asked for at a socket, each connection in a thread of its own, for ever."""
    with Listener(address, "AF_UNIX", backlog=128) as listener:
        while True:
            threading.Thread(target=_answer, args=(listener.accept(), run), daemon=True).start()


def _answer(connection: Connection, run: Device) -> None:
    with connection, contextlib.suppress(OSError, EOFError):  # who asked is gone
        work = connection.recv()
        try:
            answer: Left | Exception = run(work)
        except Exception as error:  # it is the caller's
            answer = error
        connection.send(answer)


def main() -> None:
    """Serve the GPU at the socket that the command line names, until standard input ends with its writer.

    The folder of the socket is deleted then. ``--emulated``, after the socket, is for tests without a GPU.
    """
    address, emulated = Path(sys.argv[1]), "--emulated" in sys.argv
    try:
        with exit_on_error():
            if not emulated:
                device.connect()
        run = emulation.run if emulated else device.run
        threading.Thread(target=serve, args=(str(address), run), daemon=True).start()
        sys.stdin.read()
    finally:
        shutil.rmtree(address.parent)


if __name__ == "__main__":
    main()
