"""What the workflow itself needs: the start of an invocation and of a job, and progress."""
