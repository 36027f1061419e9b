"""Simplifies meshes for a page: near corners become one corner, until the triangles are few enough."""

from __future__ import annotations

import numpy as np

from urdfsync.urdf.meshes.geometry import Triangles
from urdfsync.urdf.meshes.process import MeshFacts

_FINE = 1 << 20
"""Cells along the longest edge of an unsimplified mesh: too fine to see."""
_COARSE = 512
"""Number of cells along the longest edge at the first attempt to simplify."""


def packed(mesh: Triangles, most: int) -> tuple[bytes, MeshFacts]:
    """Return about `most` triangles with shared corners, as `scene.PageMesh` needs them."""
    cells = _FINE if len(mesh.faces) <= most else _COARSE
    while True:
        points, faces = _clustered(mesh, cells)
        if len(faces) <= most or cells <= 8:
            break
        # the number of triangles grows with the square of the cells
        cells = max(8, min(cells * 3 // 4, int(cells * (most / len(faces)) ** 0.5)))
    single = points.astype("<f4")
    box = [*single.min(axis=0).tolist(), *single.max(axis=0).tolist()]
    numbers = {"points": len(points), "faces": len(faces), "total": len(mesh.faces), "box": box}
    return single.tobytes() + faces.astype("<u4").tobytes(), {**numbers, "cells": 0 if cells == _FINE else cells}


def _clustered(mesh: Triangles, cells: int) -> Triangles:
    """Replace all corners in a cell of a grid by one point. Remove triangles without area."""
    points = mesh.points
    least = points.min(axis=0)
    edge = float(np.ptp(points, axis=0).max()) or 1.0
    grid = np.floor((points - least) / edge * cells + 0.5).astype(np.int64)
    keys = (grid[:, 0] << 42) | (grid[:, 1] << 21) | grid[:, 2]
    _, first, number = np.unique(keys, return_index=True, return_inverse=True)
    number = number.reshape(-1)
    if cells == _FINE:
        means = points[first]
    else:
        counts = np.bincount(number)
        means = np.stack([np.bincount(number, points[:, axis]) / counts for axis in range(3)], axis=1)
    corners = number[mesh.faces]
    has_area = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
    return Triangles(means, corners[has_area])
