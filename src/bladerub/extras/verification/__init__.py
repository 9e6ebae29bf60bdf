"""The error of a run: finer steps, the other scheme, neighbouring starts."""
