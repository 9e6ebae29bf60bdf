"""How long the jobs of a study take, by measurements of the paper's."""

SECONDS_PER_REVOLUTION = 0.0033
"""Of one core, for a run of the paper's blade on a soft coating. Measured with the other core at work, at
seven speeds on 17 coatings and the rigid casing, as were `bladerub.workflow.cores.STIFF` and
`ON_RIGID_CASING`."""

GROWING = 0.09
"""Share of the runs that grow, and go on to the longer length (the study's 63 coatings)."""

SECONDS_PER_JOB = 5
"""Of one core, to start Snakemake and the job and to draw, collect or analyse; rounded up."""

SECONDS_AT_FIRST = {"blade": 15, "compile_kernel": 15}
"""Of one core, for the jobs that are made once, by their rule."""
