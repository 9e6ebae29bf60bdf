"""``bladerub status``: what of the study is done."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from shutil import get_terminal_size
from typing import Any

from tqdm import tqdm

from bladerub.cli import inputs
from bladerub.io.errors import message_for

_COLUMNS = ("planned", "done", "missing", "stale", "corrupt", "unbounded")


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "status",
        help="count the runs of the study that are done, missing, stale, corrupt and unbounded",
        description="Compare the runs in the results folder with the plan, coating by coating. Nothing is "
        "computed or changed. Stale runs are those of another blade, solver or setting; the next "
        "snakemake computes them anew, as it does missing and corrupt ones.",
    )
    parser.set_defaults(command=status)
    inputs.add_config_to(parser)
    parser.add_argument(
        "--thorough",
        action="store_true",
        help="read every run to its end, which finds damage inside a file as well (some minutes)",
    )
    parser.add_argument("--json", action="store_true", help="print the counts as JSON")


def status(options: argparse.Namespace) -> None:
    """Count the runs of the study and print the counts.

    Raises
    ------
    ConfigError
        If the config is at fault.
    """
    config = inputs.read_config(options)

    from bladerub.study.grid import coating_cases, speeds
    from bladerub.study.inventory import take, total
    from bladerub.study.key import blade_digest

    results = inputs.ROOT / config["results"]
    model = results / "blade" / "reduced_model.h5"
    digest, note = None, None
    try:
        if not model.exists():
            note = f"there is no blade yet, so every run counts as stale: {model}"
        elif not inputs.is_of(config, model):
            note = f"the blade is of another config, so every run counts as stale: {model}"
        else:
            digest = blade_digest(model)
    except OSError as error:
        note = f"every run counts as stale without its blade: {message_for(error)}"
    cases, damaged = coating_cases(config), []
    with tqdm(
        total=len(cases) * len(speeds(config)),
        unit="run",
        ncols=get_terminal_size().columns,
        disable=True if options.json else None,
        leave=False,
    ) as bar:
        inventories = {
            case.name: take(
                config,
                case,
                results / "runs" / case.name,
                digest,
                options.thorough,
                seen=lambda: bar.update(),
                damaged=damaged.append,
            )
            for case in cases
        }
    whole = total(inventories.values())
    if options.json:
        told = asdict(whole) | {"note": note, "damaged": [str(path) for path in damaged]}
        coatings = {name: asdict(inventory) for name, inventory in inventories.items()}
        print(json.dumps(told | {"coatings": coatings}, indent=2))
        return
    width = max(len(name) for name in ["coating", *inventories])
    print(f"{'coating':<{width}}" + "".join(f"{column:>10}" for column in _COLUMNS) + f"{'MB':>10}")
    for name, inventory in [*inventories.items(), ("all", whole)]:
        counts = "".join(f"{getattr(inventory, column):>10}" for column in _COLUMNS)
        print(f"{name:<{width}}{counts}{inventory.bytes / 1e6:>10.1f}")
    done = f"{whole.longer_done} of {whole.longer_planned} done"
    print(f"\nlonger runs, where growth is to be confirmed: {done}")
    if damaged:
        print("damaged; delete these files and run snakemake again: they alone are computed anew")
        print("\n".join(f"  {path}" for path in damaged))
    if note:
        print(note)
