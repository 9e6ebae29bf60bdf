"""Errors of runs, of laws and of tables."""

COMMANDS = {
    "verify": "extras.verification.command",
    "compare": "extras.verification.compare_command",
    "check-law": "extras.verification.check_law",
}
