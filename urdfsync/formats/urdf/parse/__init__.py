"""Turns the bytes of a URDF into a `Robot`, with diagnostics."""
