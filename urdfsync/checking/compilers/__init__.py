"""Modelica compilers, each in a process of its own: what they are asked, and what they answer."""
