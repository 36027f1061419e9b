"""Meshes for a page: the same surface with shared corners, or a coarser one of the same extent."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from support.meshes import stl

from urdfsync.domain.scene import PageMesh
from urdfsync.formats.urdf.meshes.convert import triangles

KEY = "a.stl scale 1.0 1.0 1.0"


def ball(subdivisions: int) -> bytes:
    content: bytes = trimesh.creation.icosphere(subdivisions).export(file_type="stl")
    return content


def read(path: str, content: bytes, key: str = KEY, most: int = 60_000) -> tuple[PageMesh, trimesh.Trimesh]:
    """Return a mesh as it is for the page, and as the page reads it."""
    mesh = triangles(path, content, key, most)
    assert isinstance(mesh, PageMesh), mesh
    points = np.frombuffer(mesh.content, "<f4", 3 * mesh.points).reshape(-1, 3)
    faces = np.frombuffer(mesh.content, "<u4", offset=12 * mesh.points).reshape(-1, 3)
    assert len(faces) == mesh.faces
    return mesh, trimesh.Trimesh(points, faces, process=False)


def test_corners_are_shared_and_the_surface_stays() -> None:
    mesh, surface = read("a.stl", ball(3))
    assert (mesh.faces, mesh.points, mesh.total, mesh.cells) == (1280, 642, 1280, 0)
    assert mesh.box == pytest.approx([*surface.vertices.min(axis=0), *surface.vertices.max(axis=0)])
    assert surface.is_watertight
    assert surface.volume == pytest.approx(trimesh.creation.icosphere(3).volume, rel=1e-5)


def test_a_large_mesh_has_fewer_triangles_and_the_same_extent() -> None:
    mesh, surface = read("a.stl", ball(6), most=2000)
    assert (mesh.total, 0 < mesh.cells < 256) == (81920, True)
    assert 500 < mesh.faces <= 2000
    assert surface.volume == pytest.approx(4 / 3 * np.pi, rel=0.03)
    assert np.ptp(surface.vertices, axis=0) == pytest.approx([2, 2, 2], rel=0.03)


def test_a_mesh_has_no_scale_whether_it_is_imported_or_not() -> None:
    key, ply = "a.ply scale 2.0 2.0 -3.0", trimesh.creation.icosphere(3).export(file_type="ply")
    for path, content, size in (("", ply, 2), ("a.stl", stl(12).encode(), 6)):
        _, surface = read(path, content, key)
        assert np.ptp(surface.vertices[:, 0]) == pytest.approx(size, rel=0.01)


def test_texts_are_read_in_the_process_for_meshes() -> None:
    obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    assert np.ptp(read("a.stl", stl(2).encode())[1].vertices, axis=0).tolist() == [2, 2, 0]
    assert read("b.OBJ", obj)[0].faces == 1
    assert triangles("c.obj", b"f 1 2 3\n", KEY, 9) == "the file has no triangles"


def test_corners_that_are_no_numbers_are_left_out() -> None:
    content = bytearray(ball(1))
    content[96:100] = np.float32("nan").tobytes()
    assert read("a.stl", bytes(content))[0].faces == 79
    assert triangles("a.stl", bytes(84), KEY, 9) == "the file has no triangles"


def test_a_mesh_without_area_has_no_triangles() -> None:
    flat = f"solid a\nfacet normal 0 0 1\nouter loop\n{3 * 'vertex 1 1 1 '}\nendloop\nendfacet\nendsolid a\n"
    assert read("a.stl", flat.encode())[0].faces == 0
