"""Blades from elsewhere: a mesh, sections or matrices of another program become a blade of ours."""
