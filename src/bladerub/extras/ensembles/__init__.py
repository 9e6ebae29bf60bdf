"""One run from many starts, whatever the study makes of its peaks."""
