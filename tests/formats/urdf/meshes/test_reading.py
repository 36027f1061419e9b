"""Every format gives the same triangles, and a damaged file gives none."""

from __future__ import annotations

import base64
import itertools
import json

import numpy as np
import pytest
import trimesh

from urdfsync.formats.urdf.meshes.geometry import Array, import_form
from urdfsync.formats.urdf.meshes.lookup import mentioned_files
from urdfsync.formats.urdf.meshes.process import MeshError
from urdfsync.formats.urdf.meshes.reading import read_mesh

BOX = trimesh.creation.box((0.5, 1.0, 2.0))
Y_UP = BOX.copy().apply_transform([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""The box as glTF has it."""


def _gltf(**replaced: str) -> bytes:
    """The box as one glTF file that holds its buffers itself."""
    files = trimesh.Scene([Y_UP]).export(file_type="gltf")
    tree = json.loads(files["model.gltf"])
    for buffer in tree["buffers"]:
        inline = "data:application/octet-stream;base64," + base64.b64encode(files[buffer["uri"]]).decode()
        buffer["uri"] = replaced.get("uri", inline)
    return json.dumps(tree).encode()


FORMATS = {
    "binary.stl": BOX.export(file_type="stl"),
    "ascii.stl": BOX.export(file_type="stl_ascii").encode(),
    "shouted.stl": BOX.export(file_type="stl_ascii").upper().encode(),
    "solid.stl": b"solid" + BOX.export(file_type="stl")[5:],
    "plain.obj": BOX.export(file_type="obj").encode(),
    "library.obj": b"mtllib missing.mtl\nusemtl steel\n" + BOX.export(file_type="obj").encode(),
    "binary.ply": BOX.export(file_type="ply"),
    "ascii.ply": BOX.export(file_type="ply", encoding="ascii"),
    "plain.off": BOX.export(file_type="off").encode(),
    "scene.glb": trimesh.Scene([Y_UP]).export(file_type="glb"),
    "scene.gltf": _gltf(),
    "plain.dae": BOX.export(file_type="dae"),
}


def _read(suffix: str, content: bytes) -> Array:
    """The corners of all triangles, as the process reads them."""
    mesh, _ = import_form(read_mesh(suffix, content), (1.0, 1.0, 1.0), with_hull=False)
    return mesh.points[mesh.faces]


def _suffix(name: str) -> str:
    return "." + name.partition(".")[2]


def _sorted(corners: Array) -> list[list[float]]:
    """The triangles with their least corner first, sorted."""
    turned = [min(np.roll(triangle, n, axis=0).tolist() for n in range(3)) for triangle in corners]
    return sorted(list(itertools.chain(*triangle)) for triangle in turned)


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_gives_the_same_triangles(name: str) -> None:
    corners = _read(_suffix(name), FORMATS[name])
    assert corners.dtype == np.float64
    assert _sorted(corners) == _sorted(BOX.triangles)


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("part", [0.0, 0.1, 0.5, 0.9])
def test_a_part_of_a_file_is_no_mesh(name: str, part: float) -> None:
    content = FORMATS[name]
    cut = content.rfind(b"f ") + 3 if name.endswith(".obj") and part else int(part * len(content))
    with pytest.raises(MeshError):
        _read(_suffix(name), content[:cut])


@pytest.mark.parametrize("name", FORMATS)
def test_content_of_another_format_is_refused(name: str) -> None:
    others = [content for other, content in FORMATS.items() if _suffix(other) != _suffix(name)]
    for content in [*others, b"\0" * 500, b"<html>404</html>"]:
        with pytest.raises(MeshError):
            _read(_suffix(name), content)


def test_a_scene_of_gltf_places_its_meshes_and_its_y_is_up() -> None:
    scene = trimesh.Scene()
    scene.add_geometry(Y_UP, transform=trimesh.transformations.translation_matrix((10, 20, 30)))
    assert _read(".glb", bytes(scene.export(file_type="glb"))).reshape(-1, 3).mean(axis=0).tolist() == [10, -30, 20]


def test_a_buffer_of_gltf_may_be_a_file_below_its_folder() -> None:
    buffers = trimesh.Scene([Y_UP]).export(file_type="gltf")
    content = buffers.pop("model.gltf")
    assert mentioned_files("arm.gltf", content) == [*buffers]
    mesh = read_mesh(".gltf", content, buffers)
    assert _sorted(mesh.points[mesh.faces]) == _sorted(BOX.triangles)
    for missing in ({}, dict.fromkeys(buffers, b"")):
        with pytest.raises(MeshError, match="another file, "):
            read_mesh(".gltf", content, missing)
    for elsewhere in ("../a.bin", "b/../../a.bin", "/a.bin", "https://host/a.bin", "a.png"):
        assert mentioned_files("arm.gltf", b'{"buffers": [{"uri" : "%s"}]}' % elsewhere.encode()) == []


VERTICES = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"


@pytest.mark.parametrize(
    ("faces", "triangles"),
    [
        (b"f 1 2 3", ["012"]),
        (b"f 1/1/1 2//1 3/1", ["012"]),
        (b"f 1 2 3 4", ["012", "023"]),
        (b"f 1 2 3 4\nf 1 3 4", ["012", "023", "023"]),
        (b"  f 1 2 3\r\n\tf 1//1 3//2 4\r\n", ["012", "023"]),
        (b"f -4 -3 -2", ["012"]),
        (b"f\t1  2 \\\n 3 # last", ["012"]),
        (b"o part\ng side\ns off\nvn 0 0 1\nvt 0 0\nl 1 2\nf 2 3 4\r\n", ["123"]),
        (b"f -1 -2 -3\nv 9 9 9\nv 8 8 8", ["321"]),
        (b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1", ["012"]),
    ],
)
def test_faces_of_obj(faces: bytes, triangles: list[str]) -> None:
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    expected = [[[float(x) for x in corners[int(n)]] for n in triangle] for triangle in triangles]
    assert _sorted(_read(".obj", VERTICES + faces)) == _sorted(np.array(expected))


@pytest.mark.parametrize(("suffix", "content", "reason"), [
    (".obj", b"", "no triangles"),
    (".obj", VERTICES, "no triangles"),
    (".obj", VERTICES + b"f 1 2 5", "damaged"),
    (".obj", VERTICES + b"f 0 1 2", "no vertex has"),
    (".obj", VERTICES + b"f 1 2 -5", "no vertex has"),
    (".obj", VERTICES + b"f 1 2", "less than three"),
    (".obj", b"v 1 2\nf 1 1 1", "less than three"),
    (".obj", VERTICES + b"f 1 2 /3", "no vertex has"),
    (".obj", VERTICES + b"f 1 2 x", "damaged"),
    (".obj", b"v 0 0 zero\nf 1 1 1", "damaged"),
    (".obj", b"v 0 0 nan\nf 1 1 1", "finite"),
    (".obj", b"v 0 0 1e999\nf 1 1 1", "finite"),
    (".stl", FORMATS["binary.stl"][:-50], "the end of the file is missing"),
    (".stl", FORMATS["binary.stl"] + b"\0" * 50, "the end of the file is missing"),
    (".stl", FORMATS["ascii.stl"] + FORMATS["ascii.stl"][:-20], "the end of the file is missing"),
    (".stl", b"solid empty\nendsolid empty\n", "no triangles"),
    (".stl", b"\0" * 84, "no triangles"),
    (".stl", FORMATS["ascii.stl"].replace(b"vertex 0.25", b"vertex 0,25"), "damaged"),
    (".ply", b"\n".join(FORMATS["ascii.ply"].split(b"\n")[:-4]), "the end of the file is missing"),
    (".ply", trimesh.PointCloud(BOX.vertices).export(file_type="ply"), "no triangles"),
    (".ply", FORMATS["ascii.ply"].replace(b"\n3 ", b"\n3 -", 1), "no vertex has"),
    (".ply", FORMATS["ascii.ply"].replace(b"\n3 ", b"\n3 9", 1), "no vertex has"),
    (".off", b"\n".join(FORMATS["plain.off"].split(b"\n")[:-4]), "the end of the file is missing"),
    (".gltf", b"{", "damaged .*JSON"),
    (".gltf", _gltf(uri="arm.bin"), "another file, arm.bin"),
    (".glb", FORMATS["scene.glb"] + b"KHR_draco_mesh_compression", "compressed"),
])  # fmt: skip
def test_what_cannot_be_read_is_said(suffix: str, content: bytes, reason: str) -> None:
    with pytest.raises(MeshError, match=reason):
        _read(suffix, content)


NAMED = b"solid vertex 1 2 3\n  facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 -1e-3\n"


def test_an_ascii_stl_may_have_several_solids_and_any_names() -> None:
    solid = NAMED + b"endloop\nendfacet\nendsolid vertex 1 2 3\n"
    assert _read(".stl", solid * 2).tolist() == [[[0, 0, 0], [1, 0, 0], [0, 1, -1e-3]]] * 2
