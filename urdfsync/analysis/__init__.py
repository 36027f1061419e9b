"""What a package is used for: checks, simulations, fits, pages, patches, and comparisons of versions."""
