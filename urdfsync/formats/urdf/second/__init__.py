"""Reads the source a second time, without code of the first reader, and compares the result with a package."""
