"""Meshes for a page: the same surface with shared corners, or a coarser one of the same extent."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from support.meshes import stl

from urdfsync.urdf.meshes import simplify
from urdfsync.urdf.meshes.simplify import simplified


def ball(subdivisions: int) -> bytes:
    content: bytes = trimesh.creation.icosphere(subdivisions).export(file_type="stl")
    return content


def test_corners_are_shared_and_the_surface_stays() -> None:
    meshes, problems = simplified({"a.stl": ball(3)})
    mesh = meshes["a.stl"]
    assert (len(mesh.faces), len(mesh.points), mesh.total, mesh.is_simplified) == (1280, 642, 1280, False)
    read = trimesh.Trimesh(mesh.points, mesh.faces, process=False)
    assert read.is_watertight
    assert read.volume == pytest.approx(trimesh.creation.icosphere(3).volume, rel=1e-5)
    assert problems == {}


def test_a_large_mesh_has_fewer_triangles_and_the_same_extent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simplify, "MOST", 2000)
    mesh = simplified({"a.stl": ball(6)})[0]["a.stl"]
    assert (mesh.total, mesh.is_simplified) == (81920, True)
    assert 500 < len(mesh.faces) <= 2000
    read = trimesh.Trimesh(mesh.points, mesh.faces, process=False)
    assert read.volume == pytest.approx(4 / 3 * np.pi, rel=0.03)
    assert np.ptp(mesh.points, axis=0) == pytest.approx([2, 2, 2], rel=0.03)


def test_many_meshes_share_what_the_page_has(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(simplify, "_MOST_IN_ALL", 3000)
    meshes, _ = simplified({"a.stl": ball(5), "b.stl": ball(4)})
    assert sum(len(mesh.faces) for mesh in meshes.values()) <= 3000
    assert len(meshes["a.stl"].faces) > len(meshes["b.stl"].faces)


def test_texts_are_read_in_the_process_for_meshes() -> None:
    obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    meshes, problems = simplified({"a.stl": stl(2).encode(), "b.obj": obj, "c.obj": b"f 1 2 3\n"})
    assert np.ptp(meshes["a.stl"].points, axis=0).tolist() == [2, 2, 0]
    assert len(meshes["b.obj"].faces) == 1
    assert list(problems) == ["c.obj"]


def test_a_mesh_without_area_has_no_triangles() -> None:
    flat = f"solid a\nfacet normal 0 0 1\nouter loop\n{3 * 'vertex 1 1 1 '}\nendloop\nendfacet\nendsolid a\n"
    assert len(simplified({"a.stl": flat.encode()})[0]["a.stl"].faces) == 0
