"""State on disk between builds, and writing that survives a crash, a full disk and other writers."""
