"""Blades from elsewhere: a mesh of another program becomes a blade of ours."""
