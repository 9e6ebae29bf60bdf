"""Stage 1: geometry → mesh → elasticity → rotation → reduction, built once."""
