"""Configs checked, for people and their editors."""
