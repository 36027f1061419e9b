"""Bytes of a URDF to a `Robot`, with diagnostics that carry code, file and line."""
