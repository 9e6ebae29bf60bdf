"""Tables of the paper's claims, for pages and the README: what was measured and the verdicts of studies."""

import re
from pathlib import Path

import pandas as pd

from docs.numbers import Tables, fixed, peak, percent, rows, table

_CLAIMS = {
    "C1": "the reduced model has seven frequencies of the finite elements",
    "C2": "worn lobes: five in two ranges of speed, ten near 0.1, four near 0.38",
    "C3": "wear is greatest near 0.26 and 0.38, where eo(5) and eo(4) cross C1",
    "C4": "E = 0.11 peaks at 0.21 and 0.31, on even orders only",
    "C5": "E = 1.1: higher, and all orders",
    "C6": "Y4 is greatest at (E, K) = (1.1, 0.5)",
    "C7": "f4 rises with K",
    "C8": "for K ≤ 0.1, E hardly matters",
    "C9": "eo(6) likewise",
    "C10": "θ = 0.15 lowers amplitudes and peak speeds",
    "C11": "one θ diverges where the other does not, six lobes",
    "C12": "E above 20 is as rigid, below 0.11 nothing dangerous; a coating may be worse than none",
}
_BLOCK = re.compile(r"(?<=<!-- claims -->\n\n).*(?=\n\n<!-- end of claims -->)", re.DOTALL)

_SIGNS = {"f_omega": "f_Ω", "theta": "θ", "<=": "≤"}
_CHANGE = 0.03  # relative change of a measured value from which on it is shown beside that of another study


def claims(findings: pd.DataFrame, *groups: str) -> str:
    """Write the parts of the claims `groups` (``C2``) as a table."""
    chosen = findings[findings["id"].str.extract(r"(C\d+)", expand=False).isin(groups)]
    here = [measured(part) for _, part in chosen.iterrows()]
    parts = {"part": chosen["id"], "the paper": _statements(chosen), "here": here}
    return table(parts | {"holds": chosen["holds"]})


def counts(findings: pd.DataFrame) -> str:
    """Say how many parts hold, hold partly and do not."""
    number = findings["holds"].value_counts()
    yes, partly, no = (number.get(verdict, 0) for verdict in ("yes", "partly", "no"))
    return f"{yes} hold, {partly} hold partly and {no} do not"


def changes(
    first: pd.DataFrame, second: pd.DataFrame, headings: tuple[str, str], values: bool = False
) -> str:
    """Write the parts of which two studies give other verdicts, or with `values` other values as well."""
    both = first.merge(second, on="id", suffixes=("", "_second"))
    changed = both["holds"] != both["holds_second"]
    if values:
        numbers = both[["measured", "measured_second"]].apply(pd.to_numeric, errors="coerce")
        smaller = numbers.abs().min(axis=1)  # a run beyond the limit has an infinite growth
        changed |= numbers.diff(axis=1).iloc[:, 1].abs() > _CHANGE * smaller
    both = both[changed]
    lines = {"part": both["id"], "the paper": _statements(both)}
    for heading, study in zip(headings, (first, second), strict=True):
        parts = study.set_index("id").loc[both["id"]]
        lines[heading] = [f"{measured(part)}: {part['holds']}" for _, part in parts.iterrows()]
    return table(lines)


def variations(margins: pd.DataFrame) -> str:
    """Write the parts whose verdict is another one in some variation of the study, with those variations."""
    lines = []
    for part, answers in margins.groupby("id", sort=False):
        verdict = rows(answers, variation="study")["holds"].iloc[0]
        others = answers[answers["holds"] != verdict].groupby("holds")["variation"].agg(", ".join)
        if len(others):
            lines.append([part, verdict, "; ".join(f"{other}: {names}" for other, names in others.items())])
    return table(pd.DataFrame(lines, columns=["part", "in the study", "otherwise"]))


def changed_sentences(sentences: pd.DataFrame, findings: pd.DataFrame) -> list[str]:
    """Name the `sentences` (verdicts.csv) that were written for verdicts which are others now."""
    verdicts = findings.set_index("id")["holds"]
    changed = []
    for line in sentences.itertuples():
        others = [claim for claim in line.claims.split() if verdicts[claim] != line.verdict]
        if others:
            now = ", ".join(f"{claim} is {verdicts[claim]}" for claim in others)
            changed.append(f"{line.page}: written for {line.verdict}, {now}: {line.sentence}")
    return changed


def measured(part: pd.Series) -> str:
    """Write what was measured for one part of a claim, with its unit."""
    try:
        value = float(part["measured"])
    except ValueError:
        return part["measured"]
    if value == float("inf"):
        return "beyond the displacement limit"
    if part["unit"] == "%":
        return f"{value:.0f} %" if value >= 10 else f"{value:.2g} %"
    return f"{value:.0f}" if value.is_integer() else f"{value:.3f}"


def _statements(findings: pd.DataFrame) -> pd.Series:
    return findings["claim"].replace(_SIGNS, regex=True)


def update_readme(page: Path, tables: Tables) -> None:
    """Write between the markers of `page` how many parts hold, and for each claim what was measured."""
    findings, peaks = tables["findings"], tables["peaks"]
    here = {part["id"]: measured(part) for _, part in findings.iterrows()}
    lines = [
        [f"{claim} {_CLAIMS[claim]}", _verdict(findings, claim), answer]
        for claim, answer in _answers(here, peaks).items()
    ]
    summary = (
        f"`results/tables/findings.csv` tests {len(findings)} parts of the paper's statements: "
        f"{counts(findings)} ([figure by figure](docs/explanation/paper_vs_ours.md)). "
        "Y and f are amplitude and speed of the peak on an engine order."
    )
    block = f"{summary}\n\n{table(pd.DataFrame(lines, columns=['the paper', 'holds', 'here']))}"
    page.write_text(_BLOCK.sub(lambda _: block, page.read_text("utf-8")), encoding="utf-8")


def _verdict(findings, claim):
    """Say whether a claim holds: one word if all of its parts agree, else how many there are of each."""
    verdicts = findings[findings["id"].str.fullmatch(rf"{claim}[a-z]")]["holds"].value_counts()
    if len(verdicts) == 1:
        return verdicts.index[0]
    return ", ".join(f"{verdicts[word]} {word}" for word in ("yes", "partly", "no") if word in verdicts)


def _answers(here, peaks):
    """Return the answer to each of `_CLAIMS`; `here` has what was measured for each part."""
    greatest_4, greatest_6 = (here[part].split(" at ")[0] for part in ("C6a", "C9a"))
    straight = rows(peaks, casing="2nd", theta=0, order=4)["amplitude"]
    ridge = percent(peak(peaks, 1.1, 0.5)["amplitude"] / straight.max())
    f6 = [fixed(peak(peaks, 2, 0.5, 6, theta)["f_peak"], 3) for theta in (0.15, 0)]
    return {
        "C1": f"to {here['C1a']} (modes 1 to 6) and {here['C1b']}",
        "C2": f"five in {here['C2a']} and {here['C2b']} of the runs; "
        f"ten at {here['C2c']}, four at {here['C2d']} (fitted)",
        "C3": f"at {here['C3a']} and {here['C3b']} (the second fitted)",
        "C4": f"at {here['C4a']} and {here['C4b']} (fitted); "
        f"odd orders have {percent(here['C4c'])} % of the even ones",
        "C5": f"{fixed(here['C5a'], 1)} times on eo(4), {fixed(here['C5b'], 1)} times on eo(6), "
        f"{here['C5c']} of the orders",
        "C6": f"greatest at {greatest_4}, on a flat ridge along E; (1.1, 0.5) has {ridge} % of it",
        "C7": f"by {here['C7a']} or more for every E; at {here['C7b']} of the steps of K",
        "C8": f"f4 varies by {here['C8b']}, Y4 by {percent(here['C8a'])} % of its mean",
        "C9": f"Y6 is greatest at {greatest_6}; f6 does not fall at {here['C9c']} of the steps of K, "
        f"and varies by {here['C9e']} for K ≤ 0.1",
        "C10": f"Y4 to {percent(here['C10a'])} %, Y6 to {percent(here['C10b'])} %; "
        f"f4 changes by {here['C10c']}, f6 by {here['C10d']}",
        "C11": f"at our peaks on eo(6), {f6[0]} and {f6[1]}, and at the paper's speeds (fitted)",
        "C12": f"E = 20 against the rigid casing: {here['C12a'].split(';')[0]}; "
        f"highest Y4 and Y6: {fixed(here['C12c'], 1)} and {fixed(here['C12d'], 1)} times those of it",
    }
