"""Mesh files: finds, reads and converts them."""
