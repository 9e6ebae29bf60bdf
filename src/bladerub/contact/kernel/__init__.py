"""The compiled time loop and what it consists of."""
