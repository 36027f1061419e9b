"""Modelica as text: names, literals, tokens, syntax trees, and what names mean."""
