"""What can be wrong with a mesh file."""


class MeshError(Exception):
    """A mesh can't be used; the text is the second half of `the mesh … can't be read: it …`."""
