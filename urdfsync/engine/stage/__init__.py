"""Stages all writes of a build."""
