"""How long the jobs of a study take, by measurements of the paper's."""

SECONDS_PER_REVOLUTION = 0.0014
"""Of one core, for a run of the paper's blade on a soft coating, with the other core at work: the jobs of
the 42 softest coatings of the study (docs/data/cost.csv), and a tenth more."""

GROWING = 0.09
"""Share of the runs that grow, and go on to the longer length (the study's 63 coatings)."""

SECONDS_PER_JOB = 3
"""Of one core, to start Snakemake and the job and to draw, collect or analyse; rounded up."""

SECONDS_AT_FIRST = {"blade": 10, "compile_kernel": 10}
"""Of one core, for the jobs that are made once, by their rule."""
