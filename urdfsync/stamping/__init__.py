"""Remembering that all is in step: what a command rested on and said, so that it can be said again at once."""
