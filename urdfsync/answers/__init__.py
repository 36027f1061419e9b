"""Saved answers: a command that nothing has changed for says again what it said."""
