"""The configuration: read, laid over one another, and checked before anything is computed."""
