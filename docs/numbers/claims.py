"""Tables of the paper's claims, for pages: what was measured and the verdict, of one study or of two."""

import pandas as pd

from docs.numbers import rows, table

_SIGNS = {"f_omega": "f_Ω", "theta": "θ", "<=": "≤"}
_CHANGE = 0.03  # relative change of a measured value from which on it is shown beside that of another study


def claims(findings: pd.DataFrame, *groups: str) -> str:
    """Write the parts of the claims `groups` (``C2``) as a table."""
    chosen = findings[findings["id"].str.extract(r"(C\d+)", expand=False).isin(groups)]
    return table(
        {
            "part": chosen["id"],
            "the paper": _statements(chosen),
            "here": [measured(part) for _, part in chosen.iterrows()],
            "holds": chosen["holds"],
        }
    )


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
    answers = {}
    for heading, study in zip(headings, (first, second), strict=True):
        parts = study.set_index("id").loc[both["id"]]
        answers[heading] = [f"{measured(part)}: {part['holds']}" for _, part in parts.iterrows()]
    return table({"part": both["id"], "the paper": _statements(both)} | answers)


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
    """Name the `sentences` that were written for verdicts which are others now, with page and verdicts.

    ``docs/numbers/verdicts.csv`` lists them: page, claims, the verdict of these, how the sentence begins.
    """
    verdicts = findings.set_index("id")["holds"]
    changed = []
    for sentence in sentences.itertuples():
        others = [
            f"{claim} is {verdicts[claim]}"
            for claim in sentence.claims.split()
            if verdicts[claim] != sentence.verdict
        ]
        if others:
            changed.append(
                f"{sentence.page}: written for {sentence.verdict}, {', '.join(others)}: {sentence.sentence}"
            )
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
