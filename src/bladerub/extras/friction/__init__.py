"""The two laws of friction compared."""
