"""Write the signatures of the Python interface into docs/reference/api.md: `python -m docs.signatures`."""

import inspect
from functools import cached_property
from pathlib import Path

import bladerub

PAGE = Path(__file__).parent / "reference" / "api.md"
DATA = (property, cached_property)
SECTIONS = {
    "Studies": ("load_study", "default_study", "Study", "StudyCoating", "StudyRun", "Law"),
    "Blades": ("build_blade", "read_blade", "Blade"),
    "Runs": ("simulate", "read_run", "Run"),
    "Maps": ("simulate_speeds", "read_map", "Map"),
    "Ensembles": ("simulate_ensemble", "read_ensemble", "Ensemble"),
    "Rows of blades": ("Row", "RowBlade", "Disk"),
    "Coatings": ("fit_coating", "Rig", "simulate_rig"),
    "Errors": ("InputError", "ConfigError"),
}
MARK = "<!-- signatures, written by `python -m docs.signatures` -->\n"
END = "<!-- end of signatures -->\n"


def updated(text: str) -> str:
    """Return the text of the page with the signatures of today."""
    head, _, below = text.partition(MARK)
    parts = [head + MARK]
    for title, names in SECTIONS.items():
        parts.append(f"## {title}\n")
        parts += [_described(getattr(bladerub, name)) for name in names]
    return "\n".join(parts).rstrip() + "\n\n" + END + below.partition(END)[2]


def _described(thing: type) -> str:
    """Return signature and first line of a function or class, and a list of the members of a class."""
    is_class = inspect.isclass(thing)
    error = is_class and issubclass(thing, Exception)
    call = thing.__name__ if error else _call(thing.__name__, thing)
    members = []
    for name, member in vars(thing).items() if is_class and not error else ():
        plain = member.__func__ if isinstance(member, classmethod | staticmethod) else member
        if not name.startswith("_") and (inspect.isfunction(plain) or isinstance(plain, DATA)):
            call_of_member = _call(name, plain) if inspect.isfunction(plain) else name
            members.append(f"* `{call_of_member}`: {_first_line(plain)}")
    return "\n".join([f"**`{call}`**", f"{_first_line(thing)}\n", *members, *([""] if members else [])])


def _call(name: str, function: object) -> str:
    """Return the call of a function with its parameters and defaults, without types."""
    signature, empty = inspect.signature(function), inspect.Parameter.empty
    parameters = (part for part in signature.parameters.values() if part.name not in ("self", "cls"))
    plain = [parameter.replace(annotation=empty) for parameter in parameters]
    return name + str(signature.replace(parameters=plain, return_annotation=empty))


def _first_line(thing: object) -> str:
    """Return the first line of a description."""
    line = inspect.getdoc(thing).split("\n\n")[0]
    for old, new in (("\n", " "), ("``", "`"), ("`bladerub.", "`")):
        line = line.replace(old, new)
    return line


if __name__ == "__main__":
    PAGE.write_text(updated(PAGE.read_text("utf-8")), encoding="utf-8")
