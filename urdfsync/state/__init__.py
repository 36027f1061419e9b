"""State on disk between builds, and writes that survive a crash, a full disk and other writers."""
