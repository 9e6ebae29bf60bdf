"""Remedies for what Snakemake does when it is interrupted, terminated or started twice."""
