"""Compiled arithmetic: eight numbers as one value, and machine code kept on disk."""
