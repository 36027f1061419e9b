"""Keep Modelica models in step with URDF sources."""

__version__ = "0.1.0"
