"""The differences of two robots in the words of URDF, and their effects on the whole robot."""
