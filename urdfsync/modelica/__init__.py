"""Modelica as text: names, literals, tokens, syntax trees, and the resolution of names."""
