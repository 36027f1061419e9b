"""Compares two versions of a model, from files or git revisions."""
