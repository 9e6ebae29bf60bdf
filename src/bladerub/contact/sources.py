"""The sources of what computes a run: it is valid for these alone, and so is the machine code."""

from bladerub.io.sources import digest_of


def solver_digest() -> str:
    """Digest the source of what computes a run: contact, numerics and the reduced blade's own class."""
    return digest_of("contact", "numerics", "blade/model.py")
