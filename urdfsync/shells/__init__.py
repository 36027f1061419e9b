"""Completion in shells: the scripts, and what they ask."""
