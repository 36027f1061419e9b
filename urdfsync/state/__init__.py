"""State on disk between builds, and writes that lose nothing in a crash, on a full disk, or beside other programs."""
