"""What results were made with."""
