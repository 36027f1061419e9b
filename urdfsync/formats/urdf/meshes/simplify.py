"""Simplifies meshes for a page: near corners become one corner, until the triangles are few enough."""

from __future__ import annotations

import numpy as np

from urdfsync.formats.urdf.meshes.geometry import Triangles
from urdfsync.formats.urdf.meshes.process import MeshFacts

_FINE = 1 << 20
"""Cells along the longest edge of an unsimplified mesh: too fine to see."""
_COARSE = 512
"""Number of cells along the longest edge at the first attempt to simplify."""
_FEWEST = 8


def packed(mesh: Triangles, most: int) -> tuple[bytes, MeshFacts]:
    """Return about `most` triangles with shared corners, as `scene.PageMesh` needs them."""
    total, cells = len(mesh.faces), _FINE
    mesh = fine = _clustered(mesh, cells)  # an STL file repeats each corner six times
    while len(mesh.faces) > most and cells > _FEWEST:
        # the number of triangles grows with the square of the cells
        fewer = _COARSE if mesh is fine else int(cells * (most / len(mesh.faces)) ** 0.5)
        cells = max(_FEWEST, min(cells * 3 // 4, fewer))
        mesh = _clustered(fine, cells)
    single = mesh.points.astype("<f4")
    box = [*single.min(axis=0).tolist(), *single.max(axis=0).tolist()]
    numbers = {"points": len(mesh.points), "faces": len(mesh.faces), "total": total, "box": box}
    return single.tobytes() + mesh.faces.astype("<u4").tobytes(), {**numbers, "cells": 0 if mesh is fine else cells}


def _clustered(mesh: Triangles, cells: int) -> Triangles:
    """Replace all corners in a cell of a grid by one point. Remove triangles without area."""
    columns = np.ascontiguousarray(mesh.points.T)  # numpy is ten times slower along the other axis
    least = columns.min(axis=1)
    edge = float((columns.max(axis=1) - least).max()) or 1.0
    x, y, z = np.floor((columns - least[:, np.newaxis]) / edge * cells + 0.5).astype(np.int64)
    _, first, number = np.unique((x << 42) | (y << 21) | z, return_index=True, return_inverse=True)
    number = number.reshape(-1)
    if cells == _FINE:
        means = mesh.points[first]
    else:
        counts = np.bincount(number)
        means = np.stack([np.bincount(number, column) / counts for column in columns], axis=1)
    corners = number[mesh.faces]
    has_area = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
    return Triangles(means, corners[has_area])
