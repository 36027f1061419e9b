"""Random hostile input, by kind: each module has `run(count, seed)`, which `tests/fuzz.py` calls."""
