"""`urdfsync simulate`: a model of a package or of the user is simulated, joints are held against their limits."""
