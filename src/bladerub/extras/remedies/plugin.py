"""What Snakemake does when it is interrupted, terminated or started twice."""

REMEDIES = {"snakemake": "extras.remedies.snakemake"}
