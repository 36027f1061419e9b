"""Translates MJCF, the format of MuJoCo, into URDF; only a process of its own loads this package."""
