"""The comparison of generated packages with Pinocchio: a prescribed motion, in Modelica and in the reference."""
