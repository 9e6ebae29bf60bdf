"""Make mutants of the sources and see whether the tests notice them.

    python tests/mutation/run.py io=60 config=60 study=80 findings=60 contact=60 --seed 1 --jobs 2
    python tests/mutation/run.py --again     # those that survived, after tests were added
    python tests/mutation/run.py --named     # the faults of named.toml

Each mutant is put into a copy of the repository, and the tests of its module, then those of its room, run
there until one fails. Outcomes are added to a table, with which an interrupted run goes on. Mutants that
change nothing that can be observed are listed in equivalent.tsv, with the reason, and are not tried. The exit
code is 0 if at least 90 % of the mutants, and all named faults, are noticed.

(mutmut 3.8 chooses among the mutants of a function at run time, which numba cannot compile; cosmic-ray 8.7
removes no statements, arguments or elements, and has one test command for all.)
"""

import argparse
import csv
import queue
import random
import tempfile
import tomllib
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from copies import ROOMS, Copy, room_of
from mutants import Mutant, find_mutants, sample

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
GOAL = 0.9
COLUMNS = ("file", "line", "kind", "before", "after", "outcome", "by", "seconds")
KEY = ("file", "before", "after")
Row = dict[str, str]


def all_mutants(rooms: Sequence[str]) -> dict[str, list[Mutant]]:
    """Find the mutants of each room."""
    return {
        name: [
            mutant
            for file in ROOMS[name].sources(ROOT)
            for mutant in find_mutants(file, (ROOT / file).read_text(encoding="utf-8"))
        ]
        for name in rooms
    }


def named_faults() -> list[Mutant]:
    """Read the faults of named.toml; the text that each replaces must be in its file exactly once."""
    faults = []
    for entry in tomllib.loads((HERE / "named.toml").read_text(encoding="utf-8"))["fault"]:
        source, before = (ROOT / entry["file"]).read_text(encoding="utf-8"), entry["before"]
        if source.count(before) != 1:
            raise ValueError(f"{entry['name']}: {source.count(before)} times in {entry['file']}: {before}")
        start = len(source[: source.index(before)].encode())
        end = start + len(before.encode())
        faults.append(Mutant(entry["file"], entry["name"], start, end, entry["after"]))
    return faults


def read_rows(path: Path) -> dict[tuple[str, ...], Row]:
    """Read a table by file and lines before and after."""
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as stream:
        rows = csv.DictReader(stream, delimiter="\t", quoting=csv.QUOTE_NONE)
        return {tuple(row[name] for name in KEY): row for row in rows}


def describe(mutant: Mutant) -> Row:
    """Fill the first columns of a mutant's row."""
    line, before, after = mutant.lines((ROOT / mutant.file).read_text(encoding="utf-8"))
    values = (mutant.file, str(line), mutant.kind, before, after)
    return {name: value.replace("\t", " ") for name, value in zip(COLUMNS, values, strict=False)}


def try_all(mutants: Sequence[Mutant], jobs: int, table: Path) -> list[Row]:
    """Try mutants in `jobs` copies of the repository, and append a row of each to the table."""
    rows = []
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(jobs) as pool:
        copies: queue.Queue[Copy] = queue.Queue()
        rooms = {room_of(mutant.file): None for mutant in mutants}

        def prepare(number: int) -> None:
            copy = Copy(ROOT, Path(scratch) / str(number))
            copy.warm_up(list(rooms))
            copies.put(copy)

        def attempt(mutant: Mutant) -> Row:
            copy = copies.get()
            try:
                by, seconds = copy.try_mutant(mutant)
            finally:
                copies.put(copy)
            outcome = {"outcome": "noticed" if by else "survived", "by": by, "seconds": f"{seconds:.1f}"}
            return describe(mutant) | outcome

        list(pool.map(prepare, range(jobs)))
        for done in as_completed([pool.submit(attempt, mutant) for mutant in mutants]):
            if done.exception():
                pool.shutdown(cancel_futures=True)
            rows.append(done.result())
            append(table, rows[-1])
            print(f"{len(rows)}/{len(mutants)}", *rows[-1].values(), sep=" | ", flush=True)
    return rows


def append(table: Path, row: Row) -> None:
    """Add a row to the table, which begins with the names of its columns."""
    table.parent.mkdir(parents=True, exist_ok=True)
    is_new = not table.exists()
    with table.open("a", encoding="utf-8") as stream:
        if is_new:
            print(*COLUMNS, sep="\t", file=stream)
        print(*(row[name] for name in COLUMNS), sep="\t", file=stream)


def report(rows: Sequence[Row]) -> float:
    """Print a line a room and the survivors; return the share of mutants that was noticed."""
    counts = Counter((_room(row), row["outcome"]) for row in rows)
    for room in sorted({room for room, _ in counts}):
        noticed, survived = counts[room, "noticed"], counts[room, "survived"]
        print(f"{room:<12}{noticed:>5} of {noticed + survived} noticed")
    for row in rows:
        if row["outcome"] == "survived":
            print(f"survived: {row['file']}:{row['line']} {row['kind']}")
            print(f"  - {row['before']}\n  + {row['after']}")
    noticed = sum(row["outcome"] == "noticed" for row in rows)
    print(f"all rooms: {noticed} of {len(rows)} noticed ({noticed / max(len(rows), 1):.1%})")
    return noticed / max(len(rows), 1)


def _room(row: Row) -> str:
    return next(name for name, room in ROOMS.items() if room == room_of(row["file"]))


def choose(options: argparse.Namespace, done: dict[tuple[str, ...], Row]) -> list[Mutant]:
    """Choose what is to be tried: named faults, survivors of the table, or a sample of each room."""
    if options.named:
        return named_faults()
    equivalent = read_rows(HERE / "equivalent.tsv")
    if options.again:
        survivors = {
            key for key, row in done.items() if row["outcome"] == "survived" and key not in equivalent
        }
        found = (mutant for mutants in all_mutants(list(ROOMS)).values() for mutant in mutants)
        return list({key: mutant for mutant in found if (key := _key(mutant)) in survivors}.values())
    numbers = {name: int(number) for name, number in (part.split("=") for part in options.rooms)}
    draw, chosen = random.Random(options.seed), []
    for name, mutants in all_mutants(list(numbers)).items():
        differing = list(
            {key: mutant for mutant in mutants if (key := _key(mutant)) not in equivalent}.values()
        )
        chosen += sample(differing, numbers[name], draw)
    return [mutant for mutant in chosen if _key(mutant) not in done]


def _key(mutant: Mutant) -> tuple[str, ...]:
    row = describe(mutant)
    return tuple(row[name] for name in KEY)


def main() -> int:
    """Try mutants and say which survived."""
    parser = argparse.ArgumentParser(description="Make mutants of the sources; do the tests notice them?")
    parser.add_argument("rooms", nargs="*", metavar="ROOM=NUMBER", help=f"rooms: {', '.join(ROOMS)}")
    parser.add_argument("--named", action="store_true", help="try the faults of named.toml instead")
    parser.add_argument("--again", action="store_true", help="try again those of the table that survived")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--table", type=Path, default=ROOT / "results" / "mutation.tsv")
    options = parser.parse_args()
    table = options.table.with_stem(f"{options.table.stem}-named") if options.named else options.table
    if options.named:
        table.unlink(missing_ok=True)
    try_all(choose(options, read_rows(table)), options.jobs, table)
    equivalent = read_rows(HERE / "equivalent.tsv")
    rows = [row for key, row in read_rows(table).items() if key not in equivalent]
    return 0 if report(rows) >= (1 if options.named else GOAL) else 1


if __name__ == "__main__":
    raise SystemExit(main())
