"""What the paper leaves open, varied: sets of choices, each a small study."""
