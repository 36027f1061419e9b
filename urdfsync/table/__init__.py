"""The table domain: lists of parts, and what connects them, become Modelica by templates alone."""
