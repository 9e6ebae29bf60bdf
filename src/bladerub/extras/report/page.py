"""The page: sections of text, tables and figures in one HTML file."""

import os
from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template

import pandas as pd

from bladerub.extras.report import answers, figures, inputs
from bladerub.extras.report.results import STRESS, Results
from bladerub.extras.report.words import (
    NONE,
    band,
    growth,
    mm,
    percent,
    properties,
    ranges_in_words,
    rpm,
    title,
)

_TITLE = "At which rpm is the blade in trouble?"
_LONG = 20  # rows; a longer table scrolls
_BROKEN = 40  # characters; a longer cell is broken into lines


def build(results: Results, shown: Sequence[str], folder: Path) -> str:
    """Make the page, as HTML, with the maps of the coatings `shown`; it will be in `folder`."""
    sections = {
        "Answer": _answer(results),
        "Campbell diagram": _campbell(results),
        "Interaction speeds": _interactions(results),
        "Maps": "".join(_maps(results, name) for name in shown),
        "Warnings": _warnings(results),
        "What to change": _changes(results, shown),
        "Inputs and origin": _inputs(results, folder),
    }
    anchors = {name: name.lower().replace(" ", "-") for name in sections}
    template = files("bladerub.extras.report").joinpath("page.html").read_text(encoding="utf-8")
    return Template(template).substitute(
        title=_TITLE,
        contents="".join(f'<li><a href="#{anchor}">{name}</a></li>' for name, anchor in anchors.items()),
        sections="\n".join(
            f'<section id="{anchors[name]}">\n<h2>{name}</h2>\n{text}\n</section>'
            for name, text in sections.items()
        ),
    )


def _answer(results: Results) -> str:
    named = answers.named(results)
    half = len(named) // 2
    which = f"The {half} worst and the {half} best" if len(named) < len(results.cases) else "All coatings"
    return "".join(
        [
            *(f'<p class="answer">{escape(line)}</p>\n' for line in answers.overview(results)),
            _paragraph(
                "Amplitudes are those of node 1 at the leading edge of the tip, radially, in vibration on "
                f"the engine order. {which}, by their highest peak:"
            ),
            _list(
                f"<b>{escape(title(results.config, results.cases[name]))}</b>: "
                f"{escape(answers.sentence(results, name))}"
                for name in named
            ),
            _side_by_side(results),
        ]
    )


def _side_by_side(results: Results) -> str:
    rows = [
        {
            "coating": row.Index,
            "casing": about["casing"],
            "E": about["E"],
            "K": about["K"],
            "θ or friction μ": about["theta"],
            "highest peak (mm)": mm(row.amplitude),
            "speed (rpm)": rpm(row.rpm),
            "engine order": row.order,
            "90 % band (mm)": band(row.amplitude_low, row.amplitude_high),
            "numerical error (mm)": mm(row.amplitude_error),
            "deepest wear (mm)": mm(row.deepest),
            "diverging speeds (%)": percent(row.divergent_share),
            "speeds ended at the limit (%)": percent(row.unbounded_share),
        }
        for row in results.coatings.itertuples()
        for about in [properties(results.config, results.cases[row.Index])]
    ]
    return _table("Coatings side by side, the highest peak first", rows)


def _campbell(results: Results) -> str:
    text = (
        "Frequencies of the blade over the speed: reduced model and finite elements, and the engine orders. "
        f"Rings: peaks of the study, of all coatings. f₁(0) is {results.f1_hz:.5g} Hz."
    )
    return f"<figure>{figures.campbell(results)}<figcaption>{text}</figcaption></figure>"


def _interactions(results: Results) -> str:
    has_stress = results.peaks[STRESS].notna().any()
    names = {name: place for place, name in enumerate(results.coatings.index)}
    rows = [
        {
            "coating": peak["name"],
            "engine order": peak["order"],
            "speed (rpm)": rpm(peak["rpm"]),
            "f_Ω / f₁(0)": NONE if pd.isna(peak["f_peak"]) else f"{peak['f_peak']:.4g}",
            "amplitude (mm)": mm(peak["amplitude"]),
            "90 % band (mm)": band(peak["amplitude_low"], peak["amplitude_high"]),
            "numerical error (mm)": mm(peak["amplitude_error"]),
            "worn depth (mm)": mm(peak["max_wear"]),
            "growth": growth(peak["divergent"], peak["saturating"]),
            **({"von Mises stress (MPa)": f"{peak[STRESS] / 1e6:.0f}"} if has_stress else {}),
        }
        for peak in results.peaks.sort_values(
            "name", key=lambda name: name.map(names), kind="stable"
        ).to_dict("records")
    ]
    note = (
        "Band: where the amplitude from another start lies with a probability of 90 %. Numerical error: that "
        "of the time step, from runs with a quarter of the tolerance. Worn depth: the greatest under any "
        "node. Growth: the vibration diverges, grows but levels off, or does neither (none)."
    )
    return _table("Peak of each coating on each engine order, the worst coating first", rows) + _paragraph(
        note
    )


def _maps(results: Results, name: str) -> str:
    about = escape(title(results.config, results.cases[name]))
    return f"<h3>{about}</h3>\n" + "".join(
        f'<figure><img src="{picture}" alt="{text}: {about}"><figcaption>{text}</figcaption></figure>\n'
        for text, picture in figures.maps(results, name).items()
    )


def _warnings(results: Results) -> str:
    counts = results.runs[["name"]].assign(**answers.runs_in_doubt(results)).groupby("name").sum().astype(int)
    doubtful = counts[counts.any(axis=1)].rename(columns="{} (runs)".format)
    rows = [{"coating": name, **row} for name, row in doubtful.to_dict("index").items()]
    lines = _list(map(escape, answers.warnings(results)))
    return lines + _table("Runs to read with care", rows) or _paragraph("None.")


def _changes(results: Results, shown: Sequence[str]) -> str:
    table = results.coatings
    rows = [
        {
            "coating": name,
            "change": change,
            "highest peak (mm)": f"{mm(table.amplitude[name])} → {mm(table.amplitude[other])}",
            "deepest wear (mm)": f"{mm(table.deepest[name])} → {mm(table.deepest[other])}",
            "diverging speeds (%)": " → ".join(percent(table.divergent_share[it]) for it in (name, other)),
        }
        for name, other, change in answers.changes(results, shown)
    ]
    free = [{"coating": name, "speeds": ranges_in_words(answers.quiet(results, name), 5)} for name in shown]
    limit = f"no run grows, and all vibration is below {answers.QUIET:.0%} of the highest peak of the coating"
    return "".join(
        [
            _paragraph("Only what the study simulated, nothing in between:"),
            _list(map(escape, answers.lowest(results))),
            _table("One property changed: the lowest peak in the study", rows),
            _table(f"Speeds free of interaction: {limit}", free),
        ]
    )


def _inputs(results: Results, folder: Path) -> str:
    explorer = results.folder / "explorer.html"
    link = escape(Path(os.path.relpath(explorer.absolute(), folder)).as_posix())
    return "".join(
        [
            _table(
                "Inputs", [{"quantity": name, "value": text} for name, text in inputs.quantities(results)]
            ),
            _table("Origin", [{"what": name, "by": text} for name, text in inputs.origin(results)]),
            _paragraph(f"How to cite: {inputs.citation()}"),
            f'<p>All runs: <a href="{link}">explorer</a>.</p>\n' if explorer.exists() else "",
        ]
    )


def _paragraph(text: str) -> str:
    return f"<p>{escape(text)}</p>\n"


def _list(items: Iterable[str]) -> str:
    lines = "".join(f"<li>{item}</li>\n" for item in items)
    return f"<ul>\n{lines}</ul>\n" if lines else ""


def _table(caption: str, rows: Sequence[dict[str, object]]) -> str:
    """Write rows under their keys, the first of which names a row; nothing for no rows."""
    if not rows:
        return ""
    head = "".join(f'<th scope="col">{escape(name)}</th>' for name in rows[0])
    body = "\n".join(_row(*row.values()) for row in rows)
    return (
        f'<div class="box{" tall" if len(rows) > _LONG else ""}" tabindex="0"><table>\n'
        f"<caption>{escape(caption)}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n"
        "</table></div>\n"
    )


def _row(first: object, *cells: object) -> str:
    return f'<tr><th scope="row">{escape(str(first))}</th>{"".join(map(_cell, cells))}</tr>'


def _cell(value: object) -> str:
    """Write a cell; one with a long text may be broken."""
    text = str(value)
    kind = ' class="long"' if len(text) > _BROKEN else ""
    return f"<td{kind}>{escape(text)}</td>"
