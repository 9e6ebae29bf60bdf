"""Edit a finished study in eight ways, and count what is planned and computed for each.

    python tests/workflow/edits.py --config config/quick.yaml

The study is made once. Each edit is then made on a copy of it: Snakemake and `bladerub status` say what they
plan, Snakemake does it, and the files tell which runs were computed.
"""

import argparse
import copy
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import astuple, dataclass
from pathlib import Path
from typing import Any

from workspace import Workspace

from bladerub.config.read import load

STUDY_RUNS = "*/*.h5"
"""Without the longer runs, which are extra."""


@dataclass(frozen=True)
class Edit:
    """One edit of a study.

    Parameters
    ----------
    name : str
        What a user would call it.
    config : callable
        Changes the overlay in place.
    source : tuple of str, optional
        A file below ``src/bladerub`` that it changes instead: what, and into what.
    """

    name: str
    config: Callable[[dict[str, Any]], object] = lambda overlay: None
    source: tuple[str, str, str] | None = None


def _moduli(overlay: dict[str, Any]) -> dict[str, Any]:
    """Return the entry of coatings with several E."""
    return max(overlay["coatings"], key=lambda entry: len(entry.get("E", [])))


def _halve(group: dict[str, Any], key: str) -> None:
    group[key] /= 2


EDITS = [
    Edit("add E = 3", lambda overlay: _moduli(overlay)["E"].append(3)),
    Edit("add K = 1", lambda overlay: _moduli(overlay)["K"].append(1)),
    Edit("add theta = 0.1", lambda overlay: _moduli(overlay)["theta"].append(0.1)),
    Edit(
        "halve the speed step", lambda overlay: overlay["speeds"].update(step=overlay["speeds"]["step"] / 2)
    ),
    Edit("remove an E", lambda overlay: _moduli(overlay)["E"].pop(0)),
    Edit("change a colour", source=("plots/style.py", 'ORANGE = "#e08e0b"', 'ORANGE = "#d07f00"')),
    Edit("change the damping", lambda overlay: overlay.update(contact={"damping_ratio": 2.5e-3})),
    Edit("edit a solver module", source=("contact/modes.py", '"""', '"""In short: ')),
]


@dataclass(frozen=True)
class Outcome:
    """What an edit led to.

    Parameters
    ----------
    jobs : int
        Jobs that Snakemake planned, without the one that stands for the whole.
    coatings : int
        Those of them that compute runs.
    planned, computed : int
        Runs that were missing or stale before, as `bladerub status` counts them, and those written.
    kept : int
        Runs of before that were left as they were.
    lost : int
        Runs of before that are gone.
    left : int
        Jobs and runs still to do after it.
    """

    jobs: int
    coatings: int
    planned: int
    computed: int
    kept: int
    lost: int
    left: int


def outcome(study: Workspace, overlay: dict[str, Any], edit: Edit, *targets: str) -> Outcome:
    """Make `edit` on the finished `study`, and count what it takes to have the `targets`, by default all."""
    overlay = copy.deepcopy(overlay)
    edit.config(overlay)
    if edit.source:
        study.edit(*edit.source)
    plan = study.plan(overlay, *targets)
    planned = _to_do(study)
    runs = study.runs(STUDY_RUNS)
    study.build(overlay, *targets)
    now = study.runs(STUDY_RUNS)
    return Outcome(
        jobs=sum(plan.values()) - plan.get("all", 0),
        coatings=plan.get("coating", 0),
        planned=planned,
        computed=sum(runs.get(name) != stamp for name, stamp in now.items()),
        kept=sum(now.get(name) == stamp for name, stamp in runs.items()),
        lost=len(runs.keys() - now.keys()),
        left=sum(study.plan(overlay, *targets).values()) + _to_do(study),
    )


def _to_do(study: Workspace) -> int:
    counts = study.status()
    return counts["missing"] + counts["stale"]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--config", type=Path, required=True, metavar="FILE", help="the study, as an overlay")
    overlay = load(parser.parse_args().config)
    with tempfile.TemporaryDirectory() as folder:
        finished = Workspace.at(Path(folder) / "finished")
        finished.build(overlay)
        columns = (
            "edit",
            "jobs planned",
            "of them coatings",
            "runs planned",
            "computed",
            "kept",
            "lost",
            "left",
        )
        print(f"| {' | '.join(columns)} |")
        print(f"|{'---|' * len(columns)}")
        for number, edit in enumerate(EDITS):
            place = Path(folder) / str(number)
            found = outcome(finished.copy(place), overlay, edit)
            cells = astuple(found)
            print(f"| {edit.name} | {' | '.join(map(str, cells))} |", flush=True)
            shutil.rmtree(place)


if __name__ == "__main__":
    main()
