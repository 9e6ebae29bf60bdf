"""Which files a snakemake at work makes and needs, so that another one does not write them meanwhile.

Snakemake's own lock outlives a killed process and has to be removed by hand (``--unlock``), before anything
can be planned; so the profile switches it off (``nolock``). A claim here is a file that its process locks:
the kernel drops that lock when the process dies.
"""

import atexit
import json
import uuid
from collections.abc import Iterable
from pathlib import Path

from bladerub.io import lock
from bladerub.io.errors import BadInput


def claim(folder: str | Path, outputs: Iterable[str], inputs: Iterable[str]) -> bool:
    """Claim `outputs` to write and `inputs` to read for this process; return whether one was killed before.

    A claim is a file in `folder` and goes with its process; those of killed ones are deleted. Raises
    `BadInput` if another living process makes what this one makes or needs, or needs what this one makes.
    """
    folder = Path(folder)
    makes, needs, killed = set(map(str, outputs)), set(map(str, inputs)), False
    with lock.held(folder / ".lock", lambda: None):
        for path in sorted(folder.glob("*.json")):
            if dead := lock.attempt(path):
                path.unlink()
                dead.close()
                killed = True
                continue
            other = json.loads(path.read_text(encoding="utf-8"))
            common = (makes | needs) & set(other["makes"]) | makes & set(other["needs"])
            if common:
                raise BadInput(
                    f"another snakemake is at work in this folder, on {min(common)}: wait for its end"
                )
        path = folder / f"{uuid.uuid4().hex}.json"
        stream = lock.attempt(path)
        json.dump({"makes": sorted(makes), "needs": sorted(needs)}, stream)
        stream.flush()
    atexit.register(lambda: (path.unlink(missing_ok=True), stream.close()))
    return killed
