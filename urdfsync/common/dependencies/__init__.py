"""Records what the last complete build of each robot has read, and its result: while nothing changed, both hold."""
