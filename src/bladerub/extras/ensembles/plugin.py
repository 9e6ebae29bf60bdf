"""Ensembles of any run."""

PUBLIC = dict.fromkeys(("Ensemble", "read_ensemble", "simulate_ensemble"), "extras.ensembles.interface")
RUN_OPTIONS = {"ensemble": "extras.ensembles.run_option:EnsembleOption"}
