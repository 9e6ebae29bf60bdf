"""Numbers of studies/variations/README.md."""

from docs.numbers import decimals, fixed, headings, percent, rows, table

_SPEEDS = ["f4_soft", "f6_soft", "f6_tilted", "f6_straight"]


def numbers(tables):
    """Return the text for each name on the page."""
    calibration = _calibration(tables["calibration"], tables["calibration_counts"])
    return calibration | _robustness(tables["robustness"], tables["findings"]) | _identification(tables)


def _calibration(verdicts, counts):
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
            {"set": "set", "C4a": "f6", "C4b": "f4", "C4c": ("odd over even, %", percent)}
            | {"C2d": "four lobes", "C3b": "maximum of wear"},
        ),
        "independent": ", ".join(sorted(everywhere.index[everywhere == len(counts)])),
        "nowhere": fixed(len(rows(verdicts, id=["C6b", "C8a", "C9a", "C9d"], holds="yes"))),
        "f4_rises": fixed(len(f4_rises)),
        "worse": table(counts[counts["set"].isin(f4_rises)], {"set": "set", "worse": "worse than the study"}),
    }


def _robustness(robustness, findings):
    judged = robustness.merge(findings, on="id")
    parts = robustness.drop_duplicates("part")
    indices = robustness["decided_by"].str.extract(r"([0-9.]+)", expand=False).dropna().astype(float)
    return {
        "commit_robustness": robustness.attrs["commit"],
        "shares": table(
            robustness,
            {"id": "claim", "samples": "samples"}
            | {f"{word}_share": (f"{word}, %", percent) for word in ("yes", "partly", "no")}
            | {"reference": "own values", "predicted": ("predicted", decimals(2))}
            | {"decided_by": "decided by"},
        ),
        "growth_at_resonance": percent(rows(robustness, id="C11g")["yes_share"].iloc[0]),
        "other_verdicts": ", ".join(judged[judged["reference"] != judged["holds"]]["id"]),
        "greatest_index": fixed(indices.max(), 2),
        "predicted_most": percent(robustness["predicted"].max()),
        "predicted_median": percent(robustness["predicted"].median()),
        "samples": fixed(rows(robustness, id="C6a")["samples"].iloc[0]),
        "cost": table(
            parts,
            {"part": "part", "runs_per_sample": ("runs a sample", fixed)}
            | {"cpu_s_per_sample": ("seconds a sample, on one core", fixed)},
        ),
        "hours": fixed(((parts["samples"] + 1) * parts["cpu_s_per_sample"]).sum() / 7200, 1),
    }


def _identification(tables):
    emulators = tables["identification_emulators"].sort_values("plausible")
    targets = tables["identification_targets"].sort_values("plausible").head(5)
    last = tables["identification_waves"].iloc[-1]
    exclusions = tables["identification_exclusions"]
    names = {0: "own values", 1: "first candidate", 2: "second candidate"}
    counts = tables["identification_counts"]
    values = rows(tables["identification_candidates"], neighbour=0)
    values = values.pivot(index="factor", columns="candidate", values="value")
    values = values.rename(columns={0: "own", 1: "first", 2: "second"}).reset_index()
    factors = tables["identification_ranges"].merge(values)
    numbers = ("lowest", "highest", "own", "first", "second")
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
        "best_sets": table(
            counts.replace({"candidate": names, "neighbour": {0: "the set itself"}}),
            {"candidate": "set", "neighbour": "neighbour", "matched_yes": "matched"}
            | {"predicted_yes": "predicted", "yes": "all", "parts": "of"},
        ),
        "values": table(
            factors.replace({"factor": {"_": " "}, "unit": {"^1$": ""}}, regex=True),
            headings("factor", "unit") | {name: (name, "{:.3g}".format) for name in numbers},
        ),
    }
