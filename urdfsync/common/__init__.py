"""What all rooms share; it knows none of them."""
