"""State on disk between builds, and writes that survive crashes, a full disk, and other programs' writes."""
