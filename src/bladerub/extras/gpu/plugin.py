"""One GPU for many runs."""

SOLVERS = {"gpu": "extras.gpu.solver:Gpu"}
