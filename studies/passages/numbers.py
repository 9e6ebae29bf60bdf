"""Numbers of studies/passages/README.md."""

from docs.numbers import decimals, fixed, headings, percent, rows, span, table


def numbers(tables):
    """Return the text for each name on the page."""
    return _sweeps(tables["sweeps"]) | _long_runs(rows(tables["long_runs"], law="theta"))


def _sweeps(sweeps):
    rigid = rows(sweeps, law="coulomb", order=4, rate=[0.01, 0.05, 0.2])
    rigid = (
        rigid.drop_duplicates(["direction", "rate"])
        .pivot(index="rate", columns="direction", values="ratio")
        .reset_index()
    )
    soft, hard = rows(sweeps, E=0.11), rows(sweeps, E=[1.1, 2], theta=0)
    worn = rows(sweeps, E=2, K=0.5, theta=0, rate=0.01)
    worn = worn[~((worn["direction"] == "down") & (worn["order"] == 4))]  # the first peak of a run-down
    beyond = rows(sweeps, order=4, status="unbounded")
    return {
        "rigid": table(
            rigid, {"rate": "rate, 1/s", "up": ("run-up", decimals(2)), "down": ("run-down", decimals(2))}
        ),
        "soft": table(
            rows(soft, order=4, rate=0.01),
            {"direction": "direction", "f_peak": ("speed of the peak", decimals(3))}
            | {"f_peak_constant": ("at constant speed", decimals(3))}
            | {"ratio": ("amplitude over that at constant speed", decimals(2))},
        ),
        "soft_peaks": fixed(len(soft)),
        "soft_survive": fixed(soft["survives"].sum()),
        "worn_away": percent(worn["ratio"].max()),
        "hard_peaks": fixed(len(hard)),
        "hard_survive": fixed(hard["survives"].sum()),
        "hard_survive_eo4": fixed(len(rows(hard, survives=True, order=4, rate=[0.05, 0.2]))),
        "beyond": table(
            beyond,
            headings("E", "K", "theta", "direction")
            | {"rate": "rate, 1/s", "f_end": ("exceeds it at", decimals(3))},
        ),
        "run_downs": fixed(len(rows(sweeps, direction="down", order=4))),
        "run_downs_beyond": fixed(len(rows(beyond, direction="down"))),
        "residual": span(sweeps["energy_residual"], "{:.0e}".format),
    }


def _long_runs(runs):
    verdicts = {"unbounded": "beyond the limit", "divergent": "grow", "saturating": "saturate"}
    verdicts |= {"steady": "steady", "free": "end without contact"}
    lines = []
    for name, why, revolutions in (
        ("grow after 60 revolutions, away from the peaks", ["grows"], 125),
        ("the same", ["grows"], 500),
        ("at Y4 and Y6", ["f4", "f6"], 500),
    ):
        counts = rows(runs, why=why, revolutions=revolutions).groupby("verdict")["runs"].sum()
        lines.append(
            {"runs that": name, "after": revolutions, "runs": counts.sum()}
            | {heading: counts.get(verdict, 0) for verdict, heading in verdicts.items()}
        )
    return {"long_runs": table(lines)}
