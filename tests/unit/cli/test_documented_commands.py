import re
import shlex
from pathlib import Path

from bladerub.cli import parser

ROOT = Path(__file__).parents[3]
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *(ROOT / "docs").glob("*.md"),
    *(ROOT / "docs").glob("[!_an]*/*.md"),
    *ROOT.glob("studies/**/README.md"),
]
BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)
IN_A_LINE = re.compile(r"`(bladerub [a-z-]+ [^`]*--[^`]*)`")


def commands():
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for block in BLOCK.findall(text):
            for line in block.replace("\\\n", " ").splitlines():
                if line.startswith(".venv/bin/bladerub "):
                    yield page.name, line.split("|")[0].removeprefix(".venv/bin/")
        yield from ((page.name, command) for command in IN_A_LINE.findall(text))


def parses(command):
    words = shlex.split(command, comments=True)[1:]
    try:
        parser().parse_args(words)
    except SystemExit as end:
        return end.code == 0  # --help
    return True


def test_the_commands_of_pages_are_accepted():
    assert [command for command in sorted(set(commands())) if not parses(command[1])] == []
    assert not parses("bladerub status --deep")
