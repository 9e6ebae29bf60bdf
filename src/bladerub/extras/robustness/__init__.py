"""How far the paper's claims depend on what the paper leaves open: a design over all of it at once.

`plan` reads what varies, `design` makes the config of each sample, `sample` makes its small study and judges
the claims, `sensitivity` finds the factors that decide, and `summary` makes the tables.
"""
