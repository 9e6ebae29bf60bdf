"""Files: written whole or not at all, locked, described, and where they come from; the errors they raise."""
