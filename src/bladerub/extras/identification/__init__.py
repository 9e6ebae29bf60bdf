"""Which values of what the paper does not print agree with what it prints: history matching.

`plan` reads the factors, parts and waves, `sets` tables what these draw, `targets` lists what is matched,
`sample` simulates one set of values, `emulator` predicts the targets between the sets, `implausibility`
tells which sets are left, `waves` draws the next ones, `candidates` takes the best to a finer grid, and
`summary` makes the tables.
"""
