"""Numbers of studies/variations/robustness/README.md."""

from docs.numbers import decimals, fixed, percent, rows, table


def numbers(tables):
    """Return the text for each name on the page."""
    robustness, findings = tables["robustness"], tables["findings"]
    judged = robustness.merge(findings, on="id")
    parts = robustness.drop_duplicates("part")
    indices = robustness["decided_by"].str.extract(r"([0-9.]+)", expand=False).dropna().astype(float)
    return {
        "commit": robustness.attrs["commit"],
        "shares": table(
            robustness,
            {
                "id": "claim",
                "samples": "samples",
                "yes_share": ("yes, %", percent),
                "partly_share": ("partly, %", percent),
                "no_share": ("no, %", percent),
                "reference": "own values",
                "predicted": ("predicted", decimals(2)),
                "decided_by": "decided by",
            },
        ),
        "growth_at_resonance": percent(rows(robustness, id="C11g")["yes_share"].iloc[0]),
        "other_verdicts": ", ".join(judged[judged["reference"] != judged["holds"]]["id"]),
        "greatest_index": fixed(indices.max(), 2),
        "predicted_most": percent(robustness["predicted"].max()),
        "predicted_median": percent(robustness["predicted"].median()),
        "samples": fixed(rows(robustness, id="C6a")["samples"].iloc[0]),
        "cost": table(
            parts,
            {
                "part": "part",
                "runs_per_sample": ("runs a sample", fixed),
                "cpu_s_per_sample": ("seconds a sample, on one core", fixed),
            },
        ),
        "hours": fixed(((parts["samples"] + 1) * parts["cpu_s_per_sample"]).sum() / 7200, 1),
    }
