"""Translates SDF, the format of Gazebo, into URDF; only a process of its own loads this package.

Of the libraries on PyPI, `rod` calls Gazebo's own program to resolve includes, and forgets lines; `drake` has the real
libsdformat, but gives no elements with their lines, and is larger than urdfsync with all it needs. So this package
reads the XML itself. `tests/sdf/test_drake.py` compares the results with Drake's.
"""
