"""Turns sources into files: inspects, generates, decides, and writes. Works for any domain."""
