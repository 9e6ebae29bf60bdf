"""How far the paper's claims depend on what the paper leaves open: a design over all of it at once.

`plan` reads what varies, `design` makes the samples, `sample` makes the small study of one and puts the
claims to it, `sensitivity` tells what decides, and `summary` puts all of that into tables.
"""
