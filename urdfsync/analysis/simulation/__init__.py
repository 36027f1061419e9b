"""`urdfsync simulate`: simulates a model of a package or of the user, and compares joints with their limits."""
