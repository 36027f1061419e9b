"""Benchmarks; `python tests/benchmarks` runs them all."""
