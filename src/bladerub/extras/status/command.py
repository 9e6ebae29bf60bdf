"""``bladerub status``: what of the study is done."""

import argparse
import json
import sys
from typing import Any

from bladerub import plugins
from bladerub.api.display import bar
from bladerub.cli import inputs
from bladerub.io.errors import BadInput
from bladerub.settings.units import speeds_in_words

_COLUMNS = ("planned", "done", "missing", "stale", "corrupt", "unreadable", "unbounded")


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = inputs.add_command(
        commands,
        "status",
        status,
        blade=False,
        help="count the runs of the study that are done, missing, stale, corrupt and unbounded",
        description="Compare the runs in the results folder with the plan, coating by coating. Nothing is "
        "computed. Stale runs are those of another blade, solver or setting; the next snakemake computes "
        "them again, as missing and corrupt ones, unless the archive has what it needs.",
    )
    parser.add_argument(
        "--thorough",
        action="store_true",
        help="read every file of the results that carries a checksum to its end and compare it, which finds "
        "a single changed bit (some minutes)",
    )
    parser.add_argument(
        "--discard",
        action="store_true",
        help="delete the damaged files that are found, so that the next snakemake makes them again, and "
        "them alone",
    )


def status(options: argparse.Namespace) -> int:
    """Count the runs of the study and print the counts; return 2 if the system refuses to read any."""
    config, notes = inputs.read_config_with_notes(options)

    from bladerub.blade.cache import kept_frequency
    from bladerub.contact.result import UNBALANCED
    from bladerub.extras import inventory
    from bladerub.io.hdf5 import read_attributes
    from bladerub.study.grid import coating_cases, speeds
    from bladerub.study.plan import coating_plan

    if options.thorough and not plugins.offered("FAULTS"):
        raise BadInput("--thorough: this package is without what reads files to their ends; leave it out")
    results = inputs.study_folder() / config.results
    model = results / "blade" / "reduced_model.h5"
    digest, note = inventory.current_blade(config, model)
    faults = [examine(results) for examine in plugins.loaded("FAULTS").values()] if options.thorough else []
    known = {path for part in faults for path in part.damaged}
    cases, taken = coating_cases(config), {}
    for case in bar(len(cases), "coating", False if options.json else None, iterable=cases):
        plan, folder = coating_plan(config, case), results / "runs" / case.name
        taken[case.name] = inventory.take(config, plan, folder, digest, known)
    counting = plugins.loaded("INVENTORIES").values()
    of_rows = [part for count in counting for part in count(config, results, digest, known)]
    counts = {name: part.counts for name, part in taken.items()}
    total = inventory.total(counts.values())
    rows = inventory.total(part.counts for part in of_rows) if of_rows else None
    parts = [*taken.values(), *of_rows, *faults]
    lost_files = [path for part in faults for path in part.lost_files]
    damaged = list(dict.fromkeys(path for part in parts for path in part.damaged))
    unreadable = list(dict.fromkeys(line for part in parts for line in part.unreadable))
    for path in damaged if options.discard else ():
        if path.parent.resolve().is_relative_to(results.resolve()):  # not beyond a link
            path.unlink(missing_ok=True)
    if options.json:
        figures = total | {"note": note, "damaged": list(map(str, damaged)), "discarded": options.discard}
        figures |= {"lost": list(map(str, lost_files)), "cannot_be_read": unreadable, "coatings": counts}
        print(json.dumps(figures | ({"rows_of_blades": rows} if rows else {}), indent=2))
        return 2 if unreadable else 0
    width = max(map(len, ["coating", *counts]))
    print(inputs.row(width, "coating", *_COLUMNS, "MB"))
    for name, of_coating in (counts | {"all": total}).items():
        numbers = [f"{of_coating[column]}" for column in _COLUMNS]
        print(inputs.row(width, name, *numbers, f"{of_coating['bytes'] / 1e6:.1f}"))
    f1_hz = read_attributes(model)["f1_hz"] if digest else kept_frequency(config)
    print(f"\nspeeds: {speeds_in_words(speeds(config), f1_hz)}")
    longer = f"{total['longer_done']} of {total['longer_planned']} done"
    print(f"longer runs, where growth is to be confirmed: {longer}")
    if rows:
        counted = ", ".join(f"{rows[column]} {column}" for column in _COLUMNS)
        print(f"rows of blades: {counted}, {rows['bytes'] / 1e6:.1f} MB")
    if total["unconverged"]:
        print(f"runs with steps whose contact forces did not converge: {total['unconverged']}")
    if number := total["unbalanced"]:
        missed = f"runs whose energy ledger misses more than {UNBALANCED:g} of the work exchanged: {number}"
        print(f"{missed}; do not trust them, or lower solver.tolerance")
    state = "damaged and deleted" if options.discard else "damaged; delete them, as status --discard does"
    if damaged:
        title = f"{state}; then run snakemake again, which makes them alone:"
        print("\n  ".join([title, *map(str, damaged)]))
    if lost_files:
        title = "listed by their manifest, but not there; run snakemake again, which computes them alone:"
        print("\n  ".join([title, *map(str, lost_files)]))
    for line in filter(None, (note, *notes)):
        print(line)
    if unreadable:
        number = f"runs that cannot be read: {len(unreadable)}, kept as they are, the first of them"
        print(f"{number}\n  {unreadable[0]}", file=sys.stderr)
        return 2
    return 0
