"""From sources to files: inspect, generate, decide, and carry out. Knows no domain."""
