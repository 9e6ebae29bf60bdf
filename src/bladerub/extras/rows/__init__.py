"""Rows of blades that rub on one coating, each on what the others have left."""
