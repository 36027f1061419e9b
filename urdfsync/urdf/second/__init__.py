"""A second reading of the source, which shares no code with the first, and its comparison with a package's numbers."""
