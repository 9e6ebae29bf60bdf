"""The parameters of the coating's law from measured stress-strain curves, with their uncertainty."""
