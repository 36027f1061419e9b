"""The comparison of generated packages with Pinocchio: both compute one prescribed motion."""
