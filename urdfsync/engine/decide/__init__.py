"""Decides on each file of a package."""
