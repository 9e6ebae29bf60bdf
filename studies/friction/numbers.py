"""Numbers of studies/friction/README.md."""

from docs.numbers import fixed, percent, rows


def numbers(tables):
    """Return the text for each name on the page."""
    friction = tables["friction"]
    slow, steep = rows(friction, theta=0.15), rows(friction, theta=0.3)
    reversed_ = friction[friction["reversed_coulomb"] > 0]
    others = friction[friction["reversed_coulomb"] == 0]
    beyond = rows(friction, status_theta="unbounded")
    alike = reversed_[reversed_["status_theta"] == reversed_["status_coulomb"]]
    return {
        "speeds": fixed(len(rows(slow, E=2))),
        "runs_an_angle": fixed(len(slow)),
        "reversed_015": fixed((slow["reversed_coulomb"] > 0).sum()),
        "slowest_sliding": percent(slow["slowest_sliding"].min()),
        "difference_015": f"{slow['difference'].abs().max():.0e}",
        "reversed_03": fixed((steep["reversed_coulomb"] > 0).sum()),
        "reversed_below": fixed(reversed_["f_omega"].max(), 3),
        "reversed_steps": percent(friction["reversed_coulomb"].max()),
        "difference_reversed": percent(alike["difference"].abs().max(), 1),
        "difference_others": percent(others["difference"].abs().max(), 1),
        "beyond": fixed(len(rows(beyond, status_coulomb="unbounded"))),
        "beyond_one_law": fixed((friction["status_theta"] != friction["status_coulomb"]).sum()),
    }
