"""The table domain: templates turn lists of parts and their connections into Modelica."""
