"""Saved answers: a command repeats its last output while none of its inputs has changed."""
