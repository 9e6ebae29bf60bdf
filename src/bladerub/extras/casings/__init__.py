"""Casings whose gap was measured."""
