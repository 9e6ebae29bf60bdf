"""Errors of runs, of laws, of tables and of files."""

AGREEMENTS = {"solver": "extras.verification.stability:problems"}
DOUBTS = {"frequencies": "extras.blade_doubts:doubts"}
FAULTS = {"files": "extras.verification.integrity:examine"}
COMMANDS = {
    "verify": "extras.verification.command",
    "compare": "extras.verification.compare",
    "check-law": "extras.verification.check_law",
}
