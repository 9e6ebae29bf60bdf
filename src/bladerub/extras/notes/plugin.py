"""What is worth knowing of a valid config."""

NOTES = {"study": "extras.notes.study:notes"}
