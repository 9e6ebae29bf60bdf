"""Runs repeated from other starts: one of any kind, and those that the tables of a study rest on."""
