"""Mesh files: where they are, and how they come into the package."""
