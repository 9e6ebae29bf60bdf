"""What of a study is done."""
