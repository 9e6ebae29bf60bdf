"""Numbers of docs/explanation/paper_vs_ours.md."""

from docs.numbers import decimals, fixed, mm, peak, percent, row, rows, span, table
from docs.numbers.claims import changes, claims, counts, variations

_STEPS = ("step 0.002", "step 0.001 around the peaks")
_RIDGE = [1.1, 1.5, 2.0, 5.0, 11.0, 20.0]  # moduli E of the ridge of Y4, at K = 0.5


def numbers(tables):
    """Return the text for each name on the page."""
    findings, margins = tables["findings"], tables["margins"]
    fine = rows(tables["fine_margins"], variation="study")
    longer, rigid = tables["longer_findings"], rows(tables["rigid_convergence"], complete=True)
    margin = row(margins, variation="window from the crossing", id="C9b")
    return (
        {
            "parts": fixed(len(findings)),
            "verdicts": counts(findings),
            "verdicts_fine": counts(fine),
            "verdicts_longer": counts(longer),
            "claims_fig2": claims(findings, "C1"),
            "claims_fig6": claims(findings, "C2", "C3"),
            "claims_fig8": claims(findings, "C4", "C5"),
            "claims_fig11": claims(findings, "C6", "C7", "C8", "C9"),
            "claims_fig15": claims(findings, "C10", "C11"),
            "claims_others": claims(findings, "C12"),
            "same_verdict": fixed((margins.groupby("id")["holds"].nunique() == 1).sum()),
            "variations": variations(margins),
            "changes_fine": changes(findings, fine, _STEPS, values=True),
            "changes_longer": changes(findings, longer, ("20 revolutions", "60 revolutions")),
            "f6_rise_from_crossing": fixed(margin["measured"], 3),
        }
        | _peaks(tables["peaks"])
        | _longer_peaks(tables["peaks"], tables["longer_peaks"])
        | _divergence(tables["divergence"], tables["longer_divergence"])
        | {"rigid_error": percent(rigid["amplitude_change"].abs().max(), 1)}
    )


def _peaks(peaks):
    straight = rows(peaks, casing="2nd", theta=0, order=4)
    ridge = rows(straight, K=0.5, E=_RIDGE)["amplitude"]
    rigid = rows(peaks, law="coulomb").set_index("order")
    hard_f6 = rows(peaks, casing="2nd", K=10, theta=0, order=6, E=_RIDGE)["f_peak"]
    f6 = peak(peaks, 2, 0.5, 6)["f_peak"]
    return {
        "ridge_width": percent(1 - ridge.min() / ridge.max()),
        "Y4_soft": table(
            straight[straight["K"] <= 0.1]
            .assign(amplitude=lambda peaks: peaks["amplitude"].map(mm))
            .pivot(index="K", columns="E", values="amplitude")
            .rename_axis("Y4, mm: K, E =")
            .rename(columns="{:g}".format)
            .reset_index()
        ),
        "f6_hard_low": fixed(hard_f6.min(), 3),
        "f6_hard_high": fixed(hard_f6.max(), 3),
        "f6_rigid": fixed(rigid.loc[6, "f_peak"], 3),
        "f6": fixed(f6, 3),
        "f6_above_paper": fixed(f6 - 0.197, 3),
        "worse_than_rigid": fixed(peak(peaks, 1.1, 1)["amplitude"] / rigid.loc[4, "amplitude"], 1),
        "highest_over_rigid": fixed(straight["amplitude"].max() / rigid.loc[4, "amplitude"], 1),
        "Y4_highest": mm(rows(peaks, casing="2nd", order=4)["amplitude"].max()),
    }


def _longer_peaks(peaks, longer):
    where = {"casing": "2nd", "K": 0.1, "theta": 0, "order": 4, "E": [0.5, *_RIDGE[:-1]]}
    soft = [rows(study, **where)["amplitude"] for study in (peaks, longer)]
    angles = (0.0, 0.15)
    heights = {"Y4 at (2, 0.5), mm": [f"θ = {theta:g}" for theta in angles]}
    for revolutions, study in (("20 revolutions", peaks), ("60 revolutions", longer)):
        heights[revolutions] = [mm(peak(study, 2, 0.5, theta=theta)["amplitude"]) for theta in angles]
    both = peaks.merge(longer, on=["casing", "E", "K", "theta", "order", "law"], suffixes=("", "_longer"))
    both["fall"] = both["f_peak"] - both["f_peak_longer"]
    fall = rows(both[both["E"] >= 1.1], casing="2nd", K=0.5, theta=0, order=4)["fall"]
    return {
        "Y4_soft_longer": span(soft[1], mm),
        "Y4_soft_20": span(soft[0], mm),
        "heights_longer": table(heights),
        "peaks": fixed(len(both)),
        "peaks_at_same_speed": fixed((both["fall"].abs() < 0.0065).sum()),
        "f4_fall_on_ridge": span(fall, decimals(3)),
        "f6_longer_2_5": fixed(peak(longer, 2, 5, 6)["f_peak"], 3),
        "f6_longer_11_5": fixed(peak(longer, 11, 5, 6)["f_peak"], 3),
    }


def _divergence(divergence, longer):
    within_20 = divergence[divergence["revolutions"] <= 20]
    unbounded = rows(within_20, status="unbounded")
    runs, weakest = divergence["runs"].sum(), rows(divergence, E=0.05)
    divergent, saturating = (
        rows(divergence, **{kind: True})["runs"].sum() for kind in ("divergent", "saturating")
    )
    return {
        "runs": fixed(runs),
        "unbounded": fixed(unbounded["runs"].sum()),
        "unbounded_2nd5nd": fixed(rows(unbounded, casing="2nd5nd")["runs"].sum()),
        "runs_2nd5nd": fixed(rows(divergence, casing="2nd5nd")["runs"].sum()),
        "repeated": fixed(runs - within_20["runs"].sum()),
        "divergent": fixed(divergent),
        "divergent_share": percent(divergent / runs, 1),
        "unbounded_in_the_end": fixed(rows(divergence, status="unbounded")["runs"].sum()),
        "saturating": fixed(saturating),
        "saturating_share": percent(saturating / runs, 1),
        "unbounded_longer": fixed(rows(longer, status="unbounded")["runs"].sum()),
        "unbounded_longer_2nd5nd": fixed(rows(longer, status="unbounded", casing="2nd5nd")["runs"].sum()),
        "divergent_E005": fixed(rows(weakest, divergent=True)["runs"].sum()),
        "runs_E005": fixed(weakest["runs"].sum()),
        "divergent_by_K": _shares(divergence, "K"),
        "divergent_by_E": _shares(divergence, "E"),
    }


def _shares(divergence, modulus):
    """Write the share of runs that diverge on the casing of two nodal diameters, by one modulus."""
    straight = rows(divergence, casing="2nd", theta=0, law="theta")
    straight = straight.assign(divergent=straight["divergent"] * straight["runs"]).groupby(modulus)
    shares = straight["divergent"].sum() / straight["runs"].sum()
    return table(
        [{modulus: "diverge, %"} | {f"{value:g}": percent(share, 1) for value, share in shares.items()}]
    )
