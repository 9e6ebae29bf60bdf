"""Runs repeated from slightly different starts: ensembles of any run, and the bands of a study."""

PUBLIC = dict.fromkeys(("Ensemble", "read_ensemble", "simulate_ensemble"), "extras.ensembles.interface")
RUN_OPTIONS = {"ensemble": "extras.ensembles.run_option:EnsembleOption"}
SECTIONS = {"ensemble": "extras.ensembles.settings:ENSEMBLE"}
COSTS = {"ensemble": "extras.ensembles.ensemble:expected_cost"}
