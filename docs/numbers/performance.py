"""Numbers of docs/explanation/performance.md."""

from docs.numbers import decimals, fixed, percent, rows, table


def numbers(tables):
    """Return the text for each name on the page."""
    return _loop(tables["benchmark"]) | _study(tables["divergence"], tables["cost"]) | _gpu(tables["gpu"])


def _loop(benchmark):
    def million(digits):
        return lambda steps: fixed(steps / 1e6, digits)

    def of_peak(motion):
        part = rows(benchmark, motion=motion)["fraction_of_peak"]
        return " to ".join(dict.fromkeys(map(percent, (part.min(), part.max()))))

    return {
        "speeds": table(
            benchmark,
            {
                "processor": "processor",
                "vector_bits": "bits",
                "motion": "motion",
                "steps_per_second_numpy": ("NumPy", million(3)),
                "steps_per_second_numba": ("by numba", million(2)),
                "steps_per_second_production": ("loop of the study", million(1)),
                "ratio_to_numpy": ("times NumPy", fixed),
                "ratio_to_numba": ("times numba", decimals(1)),
                "fraction_of_peak": ("fraction of peak", decimals(2)),
            },
        ),
        "study": table(
            rows(benchmark, motion="contact"),
            {
                "processor": "processor",
                "vector_bits": "bits",
                "cores": "cores",
                "seconds_per_run": ("seconds a run", decimals(3)),
                "study_minutes": ("minutes of the study", decimals(1)),
            },
        ),
        "peak_free": of_peak("free"),
        "peak_contact": of_peak("contact"),
    }


def _study(divergence, cost):
    stages = cost.replace({"stage": {"rubs": "runs"}}).groupby("stage")["wall_s"].agg(["count", "sum"])
    stages["share"] = stages["sum"] / stages["sum"].sum()
    return {
        "runs": fixed(divergence["runs"].sum()),
        "repeated": fixed(divergence[divergence["revolutions"] > 20]["runs"].sum()),
        "stages": table(
            stages.sort_values("sum", ascending=False).reset_index(),
            {
                "stage": "stage",
                "count": "jobs",
                "sum": ("wall time of the jobs, s", fixed),
                "share": ("share, %", lambda share: percent(share, 1)),
            },
        ),
        "memory": fixed(cost["memory_mb"].max()),
        "memory_coating": fixed(rows(cost, stage="rubs")["memory_mb"].max()),
    }


def _gpu(gpu):
    card = gpu.iloc[0]
    return {
        "gpu": table(
            gpu.assign(billion=gpu["gpu_steps_per_second"] / 1e9),
            {
                "gpu": "GPU",
                "gpu_runs": "runs",
                "kernel_s": ("time of the loops, s", decimals(1)),
                "billion": ("steps, 10⁹/s", decimals(1)),
                "gpu_s": ("with the host, s", decimals(1)),
                "handed_over": "left to the processor",
            },
        ),
        "gpu_compared": fixed(card["compared_runs"]),
        **{f"gpu_{name}": fixed(card[name]) for name in ("same_status", "same_steps")},
        **{f"gpu_error_{name}": f"{card[f'peak_error_{name}']:.0e}" for name in ("median", "p99", "largest")},
        "gpu_residual": f"{card['largest_residual']:.0e}",
        "gpu_host": fixed(card["gpu_s"] / card["kernel_s"], 1),
    }
