"""Stages 3 and 4: the grid of runs, their files, and what is read out of them."""
