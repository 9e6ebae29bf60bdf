"""Fig. 18: radial displacement of node 1 (m) at f_Ω = 0.197, straight and inclined coating elements."""

import sys

import pandas as pd

from bladerub.plots import style, titles
from bladerub.plots.history import history
from bladerub.study.store import read_run

sys.stderr = open(snakemake.log[0], "w", buffering=1)

runs = {}
for path in snakemake.params.runs:
    run = read_run(path)
    runs[titles.angle(run.attributes["theta"])] = run
revolution, about = run.data["revolution"], run.attributes
displacement = {name: run.data["radial_displacement"] for name, run in runs.items()}
peak = {name: run.data["revolution_peak"] for name, run in runs.items()}

pd.DataFrame({"revolution": revolution, **displacement}).to_csv(
    snakemake.output.data, index=False, float_format="%.6g"
)
title = f"{titles.moduli(about['casing'], about['E'], about['K'])}, {titles.speed(about['f_omega'])}"
style.save(
    history(revolution, displacement, peak, title),
    snakemake.output.png,
    snakemake.output.pdf,
    snakemake.params.dpi,
)
