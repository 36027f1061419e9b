"""The differences between two robots in the words of URDF, and the effects on the whole robot."""
