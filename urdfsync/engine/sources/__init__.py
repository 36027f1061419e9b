"""Reads the source of a robot, and runs the program that it needs first."""
