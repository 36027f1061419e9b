"""Imported meshes for a page: corners that lie together become one, as coarsely as the number of triangles asks."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePosixPath
from typing import Any

import numpy as np
import numpy.typing as npt

from urdfsync.scene import Triangles
from urdfsync.urdf.meshes.convert import MOST, as_stl
from urdfsync.urdf.meshes.geometry import stl_corners
from urdfsync.urdf.meshes.process import MeshError

_FINE = 1 << 20
"""Cells along the longest edge of a mesh that is shown as it is: far finer than single precision is shown."""
_COARSE = 512
"""Cells along the longest edge of one that is simplified, to begin with."""
_MOST_IN_ALL = 500_000
"""Triangles of all meshes."""


def simplified(contents: Mapping[str, bytes]) -> tuple[dict[str, Triangles], dict[str, str]]:
    """Return the triangles of imported meshes by their paths, and why some can't be read."""
    corners, problems = dict[str, npt.NDArray[np.float32]](), dict[str, str]()
    for path, content in contents.items():
        try:
            corners[path] = stl_corners(as_stl(PurePosixPath(path).suffix.lower(), content))
        except MeshError as error:
            problems[path] = str(error)
    wanted = {path: min(len(triangles), MOST) for path, triangles in corners.items()}
    share = min(1.0, _MOST_IN_ALL / max(1, sum(wanted.values())))
    meshes = dict[str, Triangles]()
    for path, triangles in corners.items():
        faces = np.arange(3 * len(triangles)).reshape(-1, 3)
        meshes[path] = merged(triangles.reshape(-1, 3), faces, int(wanted[path] * share))
    return meshes, problems


def merged(points: npt.NDArray[Any], faces: npt.NDArray[np.int64], most: int) -> Triangles:
    """Return triangles with shared corners, at `most` so many or about that."""
    cells = _FINE if len(faces) <= most else _COARSE
    while True:
        triangles = _clustered(points, faces, cells)
        if len(triangles.faces) <= most or cells <= 8:
            return triangles
        # the number of triangles of a surface goes with the square of the cells
        cells = max(8, min(cells * 3 // 4, int(cells * (most / len(triangles.faces)) ** 0.5)))


def _clustered(points: npt.NDArray[Any], faces: npt.NDArray[np.int64], cells: int) -> Triangles:
    """Return triangles whose corners in one cell of a grid are their mean; those without area go."""
    points = points.astype(np.float64)
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
    corners = number[faces]
    has_area = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 2] != corners[:, 0])
    shown = corners[has_area].astype(np.uint32)
    return Triangles(means.astype(np.float32), shown, len(faces), is_simplified=cells != _FINE)
