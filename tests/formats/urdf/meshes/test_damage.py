"""Damaged meshes of every format: each is read whole or refused in one sentence.

`URDFSYNC_CASES=20000` tries so many with fresh seeds; else it is the same few hundred.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often
from support.meshes import VERTICES, dae, gltf, ply, tenfold

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Dependency
from urdfsync.formats.urdf.meshes import process
from urdfsync.formats.urdf.meshes.convert import convert
from urdfsync.formats.urdf.meshes.lookup import BOUNDS, HULL, key, target
from urdfsync.formats.urdf.robot import Mesh, Vector

SECONDS = 0.5
"""CPU time that one mesh may take here; each that takes longer costs a process, too."""

_FACETS = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
_GLTF = gltf([{"mesh": 0, "translation": [1, 2, 3]}, {"children": [0]}], [1]).encode()
_JSON = _GLTF + b" " * (-len(_GLTF) % 4)
SOUND = (
    (".stl", bytes(80) + struct.pack("<I", 2) + struct.pack("<12fH", *range(12), 0) * 2),
    (".stl", f"solid box\n{_FACETS * 2}endsolid box\n".encode()),
    (".obj", VERTICES + b"v 0 0 1\nvn 0 0 1\nf 1 2 3 4\nf 1//1 -2//1 -1//1\n"),
    (".off", b"OFF\n# four\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
    (".ply", ply(3, 1, rest=struct.pack("<Biii", 3, 0, 1, 2))),
    (".dae", dae().encode()),
    (".dae", tenfold(2, '<matrix>1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1</matrix><instance_geometry url="#g"/>').encode()),
    (".gltf", _GLTF),
    (".glb", struct.pack("<4sIIII", b"glTF", 2, 20 + len(_JSON), len(_JSON), 0x4E4F534A) + _JSON),
)
WORDS = (
    *(b"0", b"-1", b"3", b"255", b"1e308", b"-1e999", b"nan", b"4294967295", b"99999999999999999999", b"1_0", b"0x1"),
    *(b"#", b"\\\n", b"\r", b"\0", b"\xff\xfe", b"/", b"<", b">", b'"', b"{", b"[", b"]}", b",", b"&lt;", b"\x1b[2J"),
    *(b"solid", b"vertex", b"endfacet", b"f ", b"v ", b"OFF", b"element face 9\n", b"list uint int", b"end_header\n"),
    *(b"<node>", b"</node>", b"<polylist>", b'url="#n2"', b'"children":[0]', b'"uri":"/etc/passwd"', b"#g", b"null"),
    *(struct.pack("<I", number) for number in (0, 1, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF)),
)


@st.composite
def damaged(draw: st.DrawFn) -> tuple[str, bytes]:
    """A mesh with one to six places replaced, repeated or cut out; one in many has the suffix of another format."""
    suffix, content = draw(st.sampled_from(SOUND))
    for _ in range(draw(st.integers(1, 6))):
        begin = draw(st.integers(0, len(content)))
        end = min(len(content), begin + draw(st.integers(0, 100)))
        middle = draw(
            st.sampled_from(WORDS)
            | st.binary(min_size=end - begin, max_size=end - begin)
            | st.sampled_from([1, 10, 1000]).map(content[begin:end].__mul__)
        )
        content = content[:begin] + middle + content[end:]
    if draw(st.integers(0, 50)) == 50:
        suffix = draw(st.sampled_from(SOUND))[0]
    return suffix, content


@pytest.fixture(scope="module", autouse=True)
def _little_time() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(process, "CPU_SECONDS", SECONDS)
        yield


@pytest.mark.slow
@often(60)
@given(damaged(), st.sampled_from([(1.0, 1.0, 1.0), (0.001, 0.001, 0.001), (-1.0, 2.0, 1e30)]), st.booleans())
def test_a_damaged_mesh_is_read_whole_or_refused(file: tuple[str, bytes], scale: Vector, touches: bool) -> None:
    suffix, content = file
    mesh = Mesh(f"mesh{suffix}", scale)
    facts = (BOUNDS, HULL) if touches else (BOUNDS,)
    dependency = Dependency(key(mesh), mesh.filename, (), target(mesh), "mesh", facts=facts)
    try:
        found = convert(dependency, Path(mesh.filename), content, {})
    except SourceError as error:
        (finding,) = error.diagnostics
        assert finding.message.isprintable()
        assert len(finding.message) < 500
        return
    if found.content != content:
        assert len(found.content) == 84 + 50 * int.from_bytes(found.content[80:84], "little")
    least, greatest = np.array(found.facts[BOUNDS])
    assert (least <= greatest).all()
    assert np.isfinite([*found.facts[BOUNDS], *found.facts.get(HULL, ())]).all()
