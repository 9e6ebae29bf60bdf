"""One process that has the GPU, for the jobs of a workflow: what they ask for is computed together there.

Kernels of different processes take turns on a GPU, and few runs take as long as many. So Snakemake's main
process starts this one, and each job sends its runs to it (`bladerub.extras.gpu.solver`).
"""

import contextlib
import os
import queue
import shutil
import sys
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import Future
from multiprocessing.connection import Client, Connection, Listener
from pathlib import Path

from bladerub.extras.gpu import ADDRESS, device, emulation
from bladerub.extras.gpu.batch import Device, Output, Work
from bladerub.io.errors import exit_on_error


def find() -> Device:
    """Return what runs are to be given to: the server, if there is one, or the GPU itself."""
    return ask if os.environ.get(ADDRESS) else device.run


def ask(works: Iterable[Work]) -> Iterator[Output]:
    """Let the server carry out the loop; raises `NoGpuError` if it does not answer, and what it raises."""
    address = os.environ[ADDRESS]
    works = list(works)
    try:
        with Client(address, "AF_UNIX") as connection:
            connection.send(works)
            for _ in works:
                answer = connection.recv()
                if isinstance(answer, Exception):
                    raise answer
                yield answer
    except (OSError, EOFError) as error:
        problem = f"the process that has the GPU does not answer at {address} ({error!r})"
        raise device.NoGpuError(f"{problem}; the same command goes on from what is finished") from error


_Request = tuple[Work, Future]


def serve(listener: Listener, run: Device) -> None:
    """Carry out what is asked for until `listener` is closed; `run` is called in one thread only."""
    requests: queue.SimpleQueue[_Request] = queue.SimpleQueue()
    threading.Thread(target=_compute, args=(requests, run), daemon=True).start()
    with contextlib.suppress(OSError):
        while True:
            threading.Thread(target=_answer, args=(listener.accept(), requests), daemon=True).start()


def _answer(connection: Connection, requests: "queue.SimpleQueue[_Request]") -> None:
    with connection, contextlib.suppress(OSError, EOFError):  # who asked is gone
        asked = [(work, Future()) for work in connection.recv()]
        for request in asked:
            requests.put(request)
        for _, answer in asked:
            connection.send(answer.exception() or answer.result())


def _compute(requests: "queue.SimpleQueue[_Request]", run: Device) -> None:
    while True:
        batch = [requests.get()]
        while not requests.empty():
            batch.append(requests.get())
        try:
            for (_, answer), output in zip(batch, run(work for work, _ in batch), strict=True):
                answer.set_result(output)
        except Exception as error:  # it is the callers'
            for _, answer in batch:
                if not answer.done():
                    answer.set_exception(error)


def main() -> None:
    """Serve the GPU at the socket of the command line until standard input ends; delete its folder then."""
    address, emulated = Path(sys.argv[1]), "--emulated" in sys.argv  # the latter for tests without a GPU
    try:
        with exit_on_error():
            if not emulated:
                device.connect()
        with Listener(str(address), "AF_UNIX", backlog=128) as listener:
            run = emulation.run if emulated else device.run
            threading.Thread(target=serve, args=(listener, run), daemon=True).start()
            sys.stdin.read()
    finally:
        shutil.rmtree(address.parent)


if __name__ == "__main__":
    main()
