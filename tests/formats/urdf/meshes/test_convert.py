"""What of a mesh file arrives in the package."""

from __future__ import annotations

import os
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

from urdfsync.common.diagnostics import Severity, SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.formats.urdf.meshes.convert import convert
from urdfsync.formats.urdf.meshes.lookup import BOUNDS, HULL, VOLUME, key, target
from urdfsync.formats.urdf.robot import Mesh, Vector

BOX = trimesh.creation.box(bounds=[(0, 0, 0), (1, 2, 3)])
CONTENTS = {
    ".stl": BOX.export(file_type="stl"),
    ".obj": b"mtllib missing.mtl\n" + BOX.export(file_type="obj").encode(),
    ".ply": BOX.export(file_type="ply"),
    ".dae": BOX.export(file_type="dae"),
    ".glb": trimesh.Scene([trimesh.creation.box(bounds=[(0, 0, -2), (1, 3, 0)])]).export(file_type="glb"),  # y is up
}
UNIT = (1.0, 1.0, 1.0)


def _convert(uri: str, content: bytes, scale: Vector = UNIT, facts: tuple[str, ...] = (BOUNDS,)) -> Conversion:
    mesh = Mesh(uri, scale)
    dependency = Dependency(key(mesh), uri, (), target(mesh), "mesh", facts=facts)
    return convert(dependency, Path("/ws/arm") / Path(uri).name, content, {})


def _volume(stl: bytes) -> float:
    """Negative if the triangles look inwards."""
    return float(trimesh.load_mesh(trimesh.util.wrap_as_stream(stl), "stl").volume)


@pytest.mark.parametrize("uri", ["package://arm/box.stl", "box.STL", "box.obj", "box.OBJ"])
def test_stl_and_obj_stay_as_they_are(uri: str) -> None:
    content = CONTENTS[uri[-4:].lower()]
    conversion = _convert(uri, content)
    assert conversion.content == content
    assert conversion.facts["bounds"] == [[0, 0, 0], [1, 2, 3]]


@pytest.mark.parametrize("suffix", [".ply", ".dae", ".glb", ".DAE"])
def test_other_formats_become_binary_stl(suffix: str) -> None:
    conversion = _convert("box" + suffix, CONTENTS[suffix.lower()])
    (count,) = struct.unpack_from("<I", conversion.content, 80)
    assert count == 12
    assert len(conversion.content) == 84 + 12 * 50
    assert not conversion.content.startswith(b"solid")
    assert _volume(conversion.content) == pytest.approx(6)
    assert conversion.facts["bounds"] == [[0, 0, 0], [1, 2, 3]]
    assert conversion.facts["volume"] == 6


def test_an_open_mesh_has_no_volume() -> None:
    box = trimesh.creation.box((1, 2, 3))
    box.update_faces(range(10))
    assert _convert("open.stl", box.export(file_type="stl")).facts["volume"] == 0


UNUSED = b"v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 -1\nf 1 3 4\n"


@pytest.mark.parametrize("scale", [UNIT, (1.0, 2.0, -1.0)])
@pytest.mark.parametrize(("suffix", "content"), [*CONTENTS.items(), (".obj", UNUSED)])
def test_outermost_points_come_beside_the_same_bounds_if_they_are_needed(
    suffix: str, content: bytes, scale: Vector
) -> None:
    alone, both = (_convert("a" + suffix, content, scale, facts) for facts in ((BOUNDS,), (BOUNDS, HULL)))
    assert alone.facts.keys() == {BOUNDS, VOLUME}
    assert both.content == alone.content
    assert both.facts[BOUNDS] == alone.facts[BOUNDS]
    hull = np.array(both.facts[HULL])
    assert [hull.min(axis=0).tolist(), hull.max(axis=0).tolist()] == alone.facts[BOUNDS]


@pytest.mark.parametrize("suffix", CONTENTS)
def test_scale_is_applied(suffix: str) -> None:
    conversion = _convert("box" + suffix, CONTENTS[suffix], (0.5, 2.0, 10.0))
    assert conversion.facts["bounds"] == [[0, 0, 0], [0.5, 4, 30]]
    assert trimesh.load_mesh(trimesh.util.wrap_as_stream(conversion.content), "stl").extents.tolist() == [0.5, 4, 30]
    assert _volume(conversion.content) == pytest.approx(60)


@pytest.mark.parametrize("scale", [(-1.0, 1.0, 1.0), (1.0, -2.0, 1.0), (-1.0, -1.0, -1.0), (-1.0, -1.0, 1.0)])
def test_mirrored_mesh_still_looks_outwards(scale: Vector) -> None:
    conversion = _convert("box.stl", CONTENTS[".stl"], scale)
    assert _volume(conversion.content) == pytest.approx(6 * abs(np.prod(scale)))
    ends = np.sort([[0, 0, 0], np.multiply(scale, (1, 2, 3))], axis=0)
    assert conversion.facts["bounds"] == ends.tolist()


def test_normals_fit_the_corners_and_a_flat_triangle_has_none() -> None:
    obj = b"v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\nf 1 1 2\n"
    content = _convert("a.obj", obj, (1.0, 1.0, -1.0)).content
    facets = [struct.unpack_from("<12fH", content, 84 + 50 * n) for n in range(2)]
    assert facets[0] == (0, 0, -1, 0, 2, 0, 2, 0, 0, 0, 0, 0, 0)
    assert facets[1][:3] == (0, 0, 0)


@pytest.mark.parametrize(("uri", "content", "scale", "reason"), [
    ("package://arm/box.stl", b"garbage", UNIT, "the end of the file is missing"),
    ("package://arm/box.obj", b"garbage", UNIT, "the file has no triangles"),
    ("package://arm/box.ply", b"ply\n", UNIT, "the file is damaged or of another format "),
    ("package://arm/box.step", b"ISO-10303-21;", UNIT, "the format isn't one of "),
    ("package://arm/box.obj", CONTENTS[".obj"], (1e308, -1e308, 1e308), "the file has coordinates that are infinite"),
    ("package://arm/box.obj", b"v 0 0 1e39\nf 1 1 1", UNIT, "the file has coordinates that are infinite, or too large"),
])  # fmt: skip
def test_unreadable_mesh_is_one_diagnostic(uri: str, content: bytes, scale: Vector, reason: str) -> None:
    with pytest.raises(SourceError) as caught:
        _convert(uri, content, scale)
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.severity is Severity.ERROR
    assert diagnostic.code == "unreadable-mesh"
    assert diagnostic.file == str(Path("/ws/arm", Path(uri).name))
    assert diagnostic.message.startswith(f"the mesh {uri} can't be read: {reason}")
    assert diagnostic.hint == "export the mesh again, best as STL or OBJ"


def test_a_mesh_with_too_many_triangles_is_wanted_coarser() -> None:
    facet = bytes(50)
    content = bytes(80) + (1_000_001).to_bytes(4, "little") + facet * 1_000_001
    with pytest.raises(SourceError) as caught:
        _convert("package://arm/box.stl", content)
    (found,) = caught.value.diagnostics
    assert found.message.endswith("can't be read: the file has 1,000,001 triangles, more than 1,000,000")
    assert found.hint == "export the mesh with fewer triangles"


def test_the_command_itself_loads_no_library_for_meshes() -> None:
    program = (
        "import sys; from pathlib import Path; from urdfsync.domain import Dependency;"
        "from urdfsync.formats.urdf.meshes.convert import convert; content = b'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3';"
        "mesh = Dependency('a.obj scale 1.0 1.0 1.0', 'a.obj', (), '', 'mesh', facts=('bounds', 'hull'));"
        "assert 'hull' in convert(mesh, Path('a.obj'), content, {}).facts;"
        "print({'numpy', 'trimesh'} & sys.modules.keys())"
    )
    command = [sys.executable, "-W", "error", "-c", program]
    done = subprocess.run(command, env=os.environ | {"PYTHONWARNINGS": "error"}, capture_output=True, check=True)
    assert (done.stdout.strip(), done.stderr) == (b"set()", b"")
