"""A robot as a tree: its canonical order, poses of links, joints that move no mass, and a guess of its base."""
