"""What is worth knowing of a valid config."""
