"""One robot, from what is on disk to what is to be written. Writes nothing itself."""
