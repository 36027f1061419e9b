"""A robot as a tree: canonical order, poses of links, closed loops, loads, and joints that move no mass."""
