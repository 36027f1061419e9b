"""Turns edits of generated records into a patch of the source."""
