"""Numbers of studies/variations/identification/README.md."""

from docs.numbers import fixed, percent, rows, significant, table

_SPEEDS = ["f4_soft", "f6_soft", "f6_tilted", "f6_straight"]


def numbers(tables):
    """Return the text for each name on the page."""
    emulators = tables["identification_emulators"].sort_values("plausible")
    targets = tables["identification_targets"].sort_values("plausible").head(5)
    last = tables["identification_waves"].iloc[-1]
    exclusions = tables["identification_exclusions"]
    return {
        "explained_speeds": percent(rows(emulators, target=_SPEEDS)["explained"].min()),
        "explained_median": percent(emulators["explained"].median()),
        "explained_least": percent(emulators["explained"].min()),
        "within_two": percent(emulators["within_two"].mean()),
        "remaining": percent(last["remaining"]),
        "given_up": fixed(last["given_up"]),
        "most_exclusive": table(
            emulators.head(3).replace({"target": {"_": " "}}, regex=True),
            {"target": "target that rules out most", "plausible": ("volume that it leaves, %", percent)},
        ),
        "least_met": table(
            targets.replace({"target": {"_": " "}}, regex=True),
            {"target": "target", "plausible": ("sets that meet it, %", percent)},
        ),
        "exclusions": fixed(len(exclusions)),
        "excluded_pairs": ", ".join((exclusions["id"] + " and " + exclusions["other_id"]).head(6)),
        "best_sets": _best_sets(tables["identification_counts"]),
        "values": _values(tables["identification_ranges"], tables["identification_candidates"]),
    }


def _best_sets(counts):
    names = {
        "candidate": {0: "own values", 1: "first candidate", 2: "second candidate"},
        "neighbour": {0: "the set itself"},
    }
    return table(
        counts.replace(names),
        {
            "candidate": "set",
            "neighbour": "neighbour",
            "matched_yes": "matched",
            "predicted_yes": "predicted",
            "yes": "all",
            "parts": "of",
        },
    )


def _values(ranges, candidates):
    values = rows(candidates, neighbour=0).pivot(index="factor", columns="candidate", values="value")
    values = values.rename(columns={0: "own", 1: "first", 2: "second"}).reset_index()
    factors = ranges.merge(values).replace({"factor": {"_": " "}, "unit": {"^1$": ""}}, regex=True)
    numbers = ("lowest", "highest", "own", "first", "second")
    return table(
        factors, {"factor": "factor", "unit": "unit"} | {name: (name, significant) for name in numbers}
    )
