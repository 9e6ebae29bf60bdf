"""What a study costs: processor time, memory, and minutes on more cores."""
