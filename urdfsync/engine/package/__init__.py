"""Makes a package from a model: the imported files, and the texts."""
