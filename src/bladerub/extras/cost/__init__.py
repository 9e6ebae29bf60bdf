"""What a study costs: processor time and memory."""
