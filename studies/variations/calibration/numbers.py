"""Numbers of studies/variations/calibration/README.md."""

from docs.numbers import fixed, headings, percent, rows, table


def numbers(tables):
    """Return the text for each name on the page."""
    verdicts, counts = tables["calibration"], tables["calibration_counts"]
    everywhere = rows(verdicts, holds="yes")["id"].value_counts()
    f4_rises = rows(verdicts, id="C7b", holds="yes")["set"]
    measured = verdicts.pivot(index="set", columns="id", values="measured").loc[counts["set"]].reset_index()
    return {
        "commit": verdicts.attrs["commit"],
        "sets": fixed(len(counts)),
        "verdicts": table(
            counts,
            headings("set", "yes", "partly", "no")
            | {"better": "better than the study", "worse": "worse than the study"},
        ),
        "measured": table(
            measured,
            {
                "set": "set",
                "C4a": "f6",
                "C4b": "f4",
                "C4c": ("odd over even, %", percent),
                "C2d": "four lobes",
                "C3b": "maximum of wear",
            },
        ),
        "independent": ", ".join(sorted(everywhere.index[everywhere == len(counts)])),
        "nowhere": fixed(len(rows(verdicts, id=["C6b", "C8a", "C9a", "C9d"], holds="yes"))),
        "f4_rises": fixed(len(f4_rises)),
        "worse": table(counts[counts["set"].isin(f4_rises)], {"set": "set", "worse": "worse than the study"}),
    }
