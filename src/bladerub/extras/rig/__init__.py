"""Rub rigs: a rigid blade tip that is fed into a coated disk."""
