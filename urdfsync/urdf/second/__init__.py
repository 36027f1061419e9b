"""A second reading of the source, which shares no code with the first, and the package's numbers compared with it."""
