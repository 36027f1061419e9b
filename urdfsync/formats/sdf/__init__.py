"""Translates SDF, the format of Gazebo, into URDF; only a process of its own loads this package.

It reads the XML itself. Of the libraries on PyPI, `rod` 0.5 reads SDF 1.7 and newer, but neither includes nor lines.
`drake` 1.51 has the real libsdformat, but shows no elements with their lines, refuses loops, revolute2 and gearboxes,
and takes 170 MB. `sdformat` is another format. `tests/formats/sdf/test_drake.py` compares the results with Drake's.
"""
