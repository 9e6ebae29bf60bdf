"""A study of one's own."""
