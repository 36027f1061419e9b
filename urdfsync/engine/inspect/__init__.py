"""Reads all inputs of a build."""
