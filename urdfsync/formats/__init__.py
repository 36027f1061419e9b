"""The formats of sources: each reads a model, and makes a package of it."""
