"""Configs checked, for people and their editors."""

COMMANDS = {"config": "extras.config.command"}
