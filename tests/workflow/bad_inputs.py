"""Bad inputs, and what each must be answered with: one line with these words, exit code 2, nothing written.

`CONFIGS` are laid over config/config.yaml as ``overlay.yaml``: a mapping, or the text of the file. Their
answers begin with file, line and key; tests/unit/config has the wording, a sentence of each kind.
`COMMANDS` are command lines of ``bladerub``; the files that they name are made by `make_files`.
"""

import os
from collections.abc import Callable
from dataclasses import MISSING, fields
from itertools import pairwise
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from bladerub.blade.model import ReducedBlade, write_reduced_blade


def _section(span, **changes):
    plain = {"chord": 0.085, "thickness": 0.08, "camber": 30, "stagger": 30, "sweep": 0, "lean": 0}
    return plain | {"span": span} | changes


def _coatings(**changes):
    return {"coatings": [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]} | changes]}


_CASING = {
    "nodal_diameters": [2],
    "weights": [1],
    "amplitude": 0.001,
    "interference": 0.0003,
    "start_angle": 0,
}

CONFIGS: dict[str, tuple[dict[str, Any] | str, str]] = {
    "unknown key": (
        "contact:\n  damping: 0.01\n",
        "overlay.yaml:2: contact.damping =",
    ),
    "unknown group": ("coating: []\n", "overlay.yaml:1: coating ="),
    "number is text": (
        "# a comment\n\nreduction: {f_omega_max: high}\n",
        "overlay.yaml:3: reduction.f_omega_max =",
    ),
    "number with its unit": (
        {"blade": {"length": "200 mm"}},
        "overlay.yaml:2: blade.length =",
    ),
    "millimetres for metres": (
        {"blade": {"length": 200}},
        "overlay.yaml:2: blade.length =",
    ),
    "not a number": (
        {"solver": {"max_time_step": float("nan")}},
        "overlay.yaml:2: solver.max_time_step =",
    ),
    "infinite": (
        {"contact": {"modulus_unit": float("inf")}},
        "overlay.yaml:2: contact.modulus_unit =",
    ),
    "beyond all numbers": (
        "blade: {length: 1e400}\n",
        "overlay.yaml:1: blade.length =",
    ),
    "huge whole number": (
        {"solver": {"revolutions": 10**300}},
        "overlay.yaml:2: solver.revolutions =",
    ),
    "truth for a number": (
        {"solver": {"revolutions": True}},
        "overlay.yaml:2: solver.revolutions =",
    ),
    "nothing for a number": (
        {"blade": {"hub_radius": None}},
        "overlay.yaml:2: blade.hub_radius =",
    ),
    "date for a number": (
        "blade: {length: 2001-01-01}\n",
        "overlay.yaml:1: blade.length =",
    ),
    "text for a group": ("blade: big\n", "overlay.yaml:1: blade ="),
    "sections out of order": (
        {"blade": {"sections": [_section(0), _section(0.6), _section(0.5), _section(1)]}},
        "overlay.yaml:20: blade.sections[2].span =",
    ),
    "mesh turned inside out": (
        {
            "blade": {
                "sections": [
                    _section(0, thickness=0.4),
                    _section(0.1, thickness=0.01),
                    _section(0.2, thickness=0.01),
                    _section(1, thickness=0.4),
                ]
            }
        },
        "overlay.yaml:2: blade.sections:",
    ),
    "mesh beyond all memory": (
        "blade: {mesh: {chordwise: 200, thickness: 20, spanwise: 400}}\n",
        "overlay.yaml:1: blade.mesh:",
    ),
    "samples beyond all memory": (
        "contact: {elements: 100000}\nsolver: {revolutions: 10000}\n"
        "analysis: {divergence: {confirmation_revolutions: 0}}\n",
        "overlay.yaml:2: solver.revolutions =",
    ),
    "speed above the reduced model's": (
        "speeds:\n  extra:\n    - 0.197\n    - 0.41\n",
        "overlay.yaml:4: speeds.extra[1] =",
    ),
    "speed step of nothing": (
        "speeds: {step: 1e-9}\n",
        "overlay.yaml:1: speeds.step =",
    ),
    "E of nothing": (
        _coatings(E=[2, -0.11]),
        "overlay.yaml:4: coatings[0].E[1] =",
    ),
    "negative K": (
        _coatings(K=[0.5, -1]),
        "overlay.yaml:6: coatings[0].K[1] =",
    ),
    "coating without angle": (
        "coatings:\n  - {casing: 2nd, E: [2], K: [1], theta: [0]}\n  - {casing: 2nd, E: [3], K: [1]}\n"
        "analysis: {histories: []}\n",
        "overlay.yaml:3: coatings[1].theta:",
    ),
    "coating listed twice": (
        {"coatings": _coatings()["coatings"] + _coatings(E=[1, 2], theta=[0.15])["coatings"]},
        "overlay.yaml:10: coatings[1]:",
    ),
    "a million coatings": (
        _coatings(E=[index + 1 for index in range(1000)], K=[index + 1 for index in range(1000)]),
        "overlay.yaml:2: coatings[0]:",
    ),
    "E of the rigid casing": (
        {"coatings": [{"casing": "2nd", "coating": "rigid", "friction": [0], "E": [2]}]},
        "overlay.yaml:2: coatings[0].E =",
    ),
    "friction of an abradable coating": (
        _coatings(friction=[0.1]),
        "overlay.yaml:9: coatings[0].theta =",
    ),
    "negative friction": (
        {"coatings": _coatings()["coatings"] + [{"casing": "2nd", "coating": "rigid", "friction": [-0.1]}]},
        "overlay.yaml:13: coatings[1].friction[0] =",
    ),
    "unknown casing": (
        {"coatings": _coatings()["coatings"] + _coatings(casing="3nd")["coatings"]},
        "overlay.yaml:14: coatings[1].casing =",
    ),
    "casing named like a path": (
        {"casings": {"../2nd": _CASING}},
        'overlay.yaml:2: casings["../2nd"]:',
    ),
    "casing that is a path": (_coatings(casing="/tmp/2nd"), "overlay.yaml:6: coatings[0].casing ="),
    "casing with a newline": (
        {"casings": {"2nd\n": _CASING}},
        'overlay.yaml:2: casings["2nd "]:',
    ),
    "casing with too long a name": (
        {"casings": {"x" * 300: _CASING}},
        'overlay.yaml:2: casings["' + "x" * 50,
    ),
    "results outside the repository": (
        {"results": "../elsewhere"},
        "overlay.yaml:1: results =",
    ),
    "results at the root": ({"results": "/"}, "overlay.yaml:1: results ="),
    "results among the sources": (
        {"results": "src"},
        "overlay.yaml:1: results =",
    ),
    "results in a file": (
        {"results": "Snakefile/results"},
        "overlay.yaml:1: results =",
    ),
    "results with code": ({"results": "$(touch x)"}, "overlay.yaml:1: results ="),
    "template with code": (
        "__use_yte__: [touch, x]\n",
        "overlay.yaml:1: __use_yte__",
    ),
    "history of no run": (
        {"analysis": {"histories": [{"casing": "2nd", "E": 2, "K": 0.5, "theta": 0, "f_omega": 0.1911}]}},
        "overlay.yaml:6: analysis.histories[0].f_omega =",
    ),
    "window upside down": (
        {"analysis": {"peaks": {"speed_window": [1.25, 0.85]}}},
        "overlay.yaml:5: analysis.peaks.speed_window[1] =",
    ),
    "weight for no nodal diameter": (
        {"casings": {"2nd": {"weights": [1, 2]}}},
        "overlay.yaml:3: casings.2nd.weights =",
    ),
    "extends what is not there": (
        "extend: no.yaml\n",
        "overlay.yaml:1: extend =",
    ),
    "extends itself": (
        "\nextend: [overlay.yaml]\n",
        "overlay.yaml:2: extend =",
    ),
    "extends a page": (
        "extend: https://host/a.yaml\n",
        "overlay.yaml:1: extend =",
    ),
    "chart without moduli": (
        {"chart": {"E": []}},
        "overlay.yaml:2: chart.E =",
    ),
    "chart with E of nothing": (
        {"chart": {"E": [0, 1]}},
        "overlay.yaml:3: chart.E[0] =",
    ),
    "chart with K of nothing": (
        {"chart": {"K": [0, 1]}},
        "overlay.yaml:3: chart.K[0] =",
    ),
    "chart that goes back": (
        {"chart": {"K": [0.5, 5, 1]}},
        "overlay.yaml:5: chart.K[2] =",
    ),
    "chart on no casing": (
        {"chart": {"casing": "3nd"}},
        "overlay.yaml:2: chart.casing =",
    ),
    "chart above all speeds": (
        {"chart": {"speeds": {"start": 0.5}}},
        "overlay.yaml:3: chart.speeds.start =",
    ),
    "chart without a limit": (
        {"chart": {"limits": {"wear": None}}},
        "overlay.yaml:3: chart.limits.wear =",
    ),
    "number as a key": ("blade:\n  1: 2\n", "overlay.yaml:2: not valid YAML"),
    "key given twice": (
        "blade: {length: 0.2, length: 0.3}\n",
        "overlay.yaml:1: not valid YAML",
    ),
    "aliases without end": (
        "a: &a [x, x, x, x, x, x, x, x]\n"
        + "".join(f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in pairwise("abcdefg")),
        "overlay.yaml:1: not valid YAML",
    ),
}

UNREADABLE: dict[str, tuple[str | bytes, str]] = {
    "list at the top": ("- 1\n", "overlay.yaml: must hold keys at its top level"),
    "nothing at all": ("", "overlay.yaml: must hold keys at its top level"),
    "no YAML": ("results: r\nblade: [1\ncontact: 2\n", "overlay.yaml:3: not valid YAML"),
    "call of a function": (
        "a: !!python/object/apply:os.system ['touch x']\n",
        "overlay.yaml:1: not valid YAML",
    ),
    "deep nesting": (
        "a: " + "[" * 3000 + "]" * 3000,
        "overlay.yaml:1: not valid YAML",
    ),
    "groups without end": (
        "a: &a {p: x}\n"
        + "".join(
            f"{new}: &{new} {{{', '.join(f'{key}: *{old}' for key in 'pqrstuvwx')}}}\n"
            for old, new in pairwise("abcdefghijkl")
        ),
        "overlay.yaml:1: not valid YAML",
    ),
    "more digits than Python reads": (
        "blade: {length: " + "9" * 5000 + "}\n",
        "overlay.yaml:1: not valid YAML",
    ),
    "no such date": (
        "results: 2001-99-99\n",
        "overlay.yaml:1: not valid YAML",
    ),
    "zero byte": (b"results: a\0b\n", "overlay.yaml:1: not valid YAML"),
    "other encoding": ("results: r\n".encode("utf-16"), "overlay.yaml: is not text in UTF-8"),
    "Latin letters": ("results: é\n".encode("latin-1"), "overlay.yaml: is not text in UTF-8"),
    "hundred megabytes": (b"#" * 100_000_000, "overlay.yaml: is larger than 1 MB"),
}
"""Configs that Snakemake's own reading of ``--configfile`` fails on, or runs, or never ends."""

_RUN = "run --casing 2nd --E 2 --K 0.5 --f 0.19"
_RIGID = "run --casing 2nd --coating rigid --f 0.19"
_VERIFY = "verify --sample 1 --seed 1"
_SPEED = "speed must be a number from 0.001 to 2"
_YOUNG = "Young modulus must be a number above 0 and at most 1e+06"

COMMANDS: dict[str, str] = {
    "": "bladerub: the following arguments are required: COMMAND",
    "rnu": "bladerub: argument COMMAND: invalid choice: 'rnu'",
    "run": "bladerub run: the following arguments are required: --casing",
    "run --casing 2nd": "bladerub run: one of the arguments --f --rpm is required",
    "run --casing 2nd --f 0.19": "bladerub run: --E: missing, an abradable coating needs it",
    "run --casing 2nd --E 2 --f 0.19": "--K: missing, an abradable coating needs it",
    "run --casing 2dn --E 2 --K 1 --f 0.19": '"2dn": must be one of 2nd, 2nd5nd; did you mean 2nd?',
    "run --casing ../2nd --E 2 --K 1 --f 0.19": '--casing = "../2nd": must be one of 2nd, 2nd5nd',
    f"{_RUN} --E soft": "argument --E: invalid float value: 'soft'",
    f"{_RUN} --E 0": f"--E = 0: {_YOUNG}",
    f"{_RUN} --E nan": f"--E = nan: {_YOUNG}",
    f"{_RUN} --E 1e400": f"--E = inf: {_YOUNG}",
    f"{_RUN} --K -1": "--K = -1: plastic modulus must be a number from 0 to 1e+06",
    f"{_RUN} --K inf": "--K = inf: plastic modulus must be a number from 0",
    f"{_RUN} --theta 15": "--theta = 15: angle of the abradable elements must be a number from 0 to 1.5",
    f"{_RUN} --theta nan": "--theta = nan: angle of the abradable elements must be",
    f"{_RUN} --f 0": f"--f = 0: {_SPEED}",
    f"{_RUN} --f nan": f"--f = nan: {_SPEED}",
    f"{_RUN} --f 1e400": f"--f = inf: {_SPEED}",
    f"{_RUN} --f 0.41": "--f = 0.41: must be at most reduction.f_omega_max = 0.4 (normalised)",
    f"{_RUN} --f 0.19 --f": "argument --f: expected one argument",
    f"{_RUN} --theta 0.1 --friction 0.1": "--friction = 0.1: goes without theta, which says the same",
    f"{_RUN} --coating stiff": "argument --coating: invalid choice: 'stiff'",
    f"{_RIGID} --friction 1e400": "--friction = inf: coefficient of friction must be a number from 0 to 1",
    f"{_RIGID} --theta 0": "--theta = 0: goes with --coating abradable only",
    f"{_RUN} --revolutions 1": "--revolutions = 1: must be from 2 to 10000",
    f"{_RUN} --revolutions 2.5": "argument --revolutions: invalid int value: '2.5'",
    f"{_RUN} --revolutions {10**30}": f"--revolutions = {10**30}: must be from 2 to 10000",
    f"{_RUN} --revolutions {'9' * 5000}": "argument --revolutions: invalid int value: '999",
    f"{_RUN} --depth 3": "unrecognized arguments: --depth 3",
    f"{_RUN} --json=yes": "argument --json: ignored explicit argument 'yes'",
    f"{_RUN} --config": "argument --config: expected at least one argument",
    f"{_RUN} --config no.yaml": "no.yaml: cannot be read (No such file or directory)",
    f"{_RUN} --config folder": "folder: is a folder, must be a YAML file",
    f"{_RUN} --config pipe": "pipe: is not a regular file, must be a YAML file",
    f"{_RUN} --config loop": "loop: cannot be read (Too many levels of symbolic links)",
    f"{_RUN} --config {'x' * 300}": ": cannot be read (File name too long)",
    f"{_RUN} --config sound.h5": "sound.h5: is not text in UTF-8",
    f"{_RUN} --output folder": "--output folder: is a folder, must be a file",
    f"{_RUN} --output text/run.h5": "--output text/run.h5: cannot be written, ",
    f"{_RUN} --output text": "--output text: is there and is no run, must be a new file or a run to replace",
    f"{_RUN} --output sound.h5": "--output sound.h5: is there and is no run, must be a new file or a run",
    f"{_RUN} --output /dev/null": "--output /dev/null: is there and is no run, must be a new file or a run",
    f"{_RUN} --output loop": "--output loop: is there and is no run",
    f"{_RUN} --output {'x' * 300}": "x: cannot be written (File name too long)",
    f"{_RUN} --blade no.h5": "no.h5: No such file or directory",
    f"{_RUN} --blade folder": "folder: is a folder, must be a reduced blade (HDF5)",
    f"{_RUN} --blade pipe": "pipe: is not a regular file, must be a reduced blade (HDF5)",
    f"{_RUN} --blade /dev/zero": "/dev/zero: is not a regular file, must be a reduced blade (HDF5)",
    f"{_RUN} --blade text": "text: not a readable HDF5 file",
    f"{_RUN} --blade empty": "empty: not a readable HDF5 file",
    f"{_RUN} --blade truncated.h5": "truncated.h5: not a readable HDF5 file",
    f"{_RUN} --blade other.h5": "other.h5: not a reduced blade, 'mass' is missing",
    f"{_RUN} --blade nan.h5": "nan.h5: not a valid reduced blade, mass: must be finite, has NaN or infinite",
    f"{_RUN} --blade infinite.h5": "infinite.h5: not a valid reduced blade, stiffness_1: must be finite",
    f"{_RUN} --blade negative.h5": "negative.h5: not a valid reduced blade, mass: must be positive definite",
    f"{_RUN} --blade lopsided.h5": "lopsided.h5: not a valid reduced blade, stiffness_0: must be symmetric",
    f"{_RUN} --blade small.h5": "small.h5: not a valid reduced blade, mass: must be numbers of the shape",
    f"{_RUN} --blade words.h5": "words.h5: not a valid reduced blade, f1_hz = 'fast': must be a number",
    f"{_RUN} --blade endless.h5": "endless.h5: not a reduced blade, mass has the shape (200000, 200000)",
    f"{_RUN} --blade group.h5": "group.h5: not a reduced blade, mass has the shape None",
    f"{_RUN} --f 0.45 --blade sound.h5": "--f = 0.45: must be at most 0.4 (normalised), the highest speed of",
    f"{_VERIFY} --sample 0": "--sample = 0: must be from 1 to 12096, the number of runs to draw from",
    f"{_VERIFY} --sample {10**30}": f"--sample = {10**30}: must be from 1 to 12096",
    f"{_VERIFY} --sample 1.5": "argument --sample: invalid int value: '1.5'",
    f"{_VERIFY} --seed -1": "--seed = -1: must be from 0 to ",
    f"{_VERIFY} --seed {10**30}": f"--seed = {10**30}: must be from 0 to ",
    f"{_VERIFY} --jobs 0": "--jobs = 0: must be from 1 to 1000",
    f"{_VERIFY} --blade nan.h5": "nan.h5: not a valid reduced blade, mass: must be finite",
    f"{_VERIFY} --config no.yaml": "no.yaml: cannot be read (No such file or directory)",
    "verify --sample 1": "the following arguments are required: --seed",
    "status --thorough=1": "argument --thorough: ignored explicit argument '1'",
    "status --config no.yaml": "no.yaml: cannot be read (No such file or directory)",
    "status results": "unrecognized arguments: results",
    "benchmark --rounds 0": "--rounds = 0: must be from 1 to 1000",
    "benchmark --rounds inf": "argument --rounds: invalid int value: 'inf'",
    f"benchmark --cores {10**30}": f"--cores = {10**30}: must be from 1 to 1000000",
    "benchmark --blade truncated.h5": "truncated.h5: not a readable HDF5 file",
    "benchmark --config rigid.yaml": "coatings: must have an abradable one, as contact with",
}


def make_files(folder: Path) -> None:
    """Make the files that `COMMANDS` name, in `folder`."""
    (folder / "folder").mkdir()
    (folder / "text").write_text("mass = 1\n")
    (folder / "empty").touch()
    (folder / "loop").symlink_to("loop")
    (folder / "rigid.yaml").write_text(
        "coatings: [{casing: 2nd, coating: rigid, friction: [0]}]\nanalysis: {histories: []}\n"
    )
    os.mkfifo(folder / "pipe")
    sound = folder / "sound.h5"
    write_reduced_blade(sound, _blade(), {})
    (folder / "truncated.h5").write_bytes(sound.read_bytes()[:3000])
    for name, damage in _DAMAGES.items():
        (folder / name).write_bytes(sound.read_bytes())
        with h5py.File(folder / name, "r+") as file:
            damage(file)


def _blade() -> ReducedBlade:
    """Make a blade of 24 coordinates without any physics."""
    kinds = {float: 1.0, int: 6, np.ndarray: np.eye(24)}
    values = {field.name: kinds[field.type] for field in fields(ReducedBlade) if field.default is MISSING}
    axes = np.eye(8, 3)
    nodes = {"node_position": axes, "radial_direction": axes, "tangential_direction": axes}
    return ReducedBlade(**values | nodes | {"f_omega_max": 0.4})


def _change(name: str, at: tuple[int, int], value: float) -> Callable[[h5py.File], None]:
    def damage(file: h5py.File) -> None:
        file[name][at] = value

    return damage


def _replace(name: str, **what: Any) -> Callable[[h5py.File], None]:
    def damage(file: h5py.File) -> None:
        del file[name]
        if what:
            file.create_dataset(name, **what)
        else:
            file.create_group(name)

    return damage


_DAMAGES: dict[str, Callable[[h5py.File], None]] = {
    "other.h5": lambda file: file.__delitem__("mass"),
    "nan.h5": _change("mass", (0, 0), np.nan),
    "infinite.h5": _change("stiffness_1", (3, 3), np.inf),
    "negative.h5": _change("mass", (5, 5), -1.0),
    "lopsided.h5": _change("stiffness_0", (1, 2), 0.5),
    "small.h5": _replace("mass", data=np.eye(6)),
    "words.h5": lambda file: file.attrs.__setitem__("f1_hz", "fast"),
    "endless.h5": _replace("mass", shape=(200_000, 200_000), dtype=float, chunks=(100, 100)),
    "group.h5": _replace("mass"),
}
