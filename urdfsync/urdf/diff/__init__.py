"""What the differences of two robots are in the words of URDF, and what follows from them."""
