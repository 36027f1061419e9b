"""What the differences of two robots mean."""
