"""Meshes built by code: a valid mesh, and hostile meshes, each of which must end in one finding."""

from __future__ import annotations

import base64
import json
import os
import struct
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

TRIANGLE = """<geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry>"""
PLACED = '<node><instance_geometry url="#g"/></node>'


def stl(size: float = 1, height: float = 0) -> str:
    """An STL file with one triangle, whose last corner is at this height."""
    corners = f"vertex 0 0 0\nvertex {size} 0 0\nvertex 0 {size} {height}\n"
    return f"solid tip\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid tip\n"


def dae(scene: str = PLACED, nodes: str = "", geometry: str = TRIANGLE, asset: str = "", libraries: str = "") -> str:
    """A COLLADA file."""
    return (
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
        f"<asset>{asset}</asset>{libraries}<library_geometries>{geometry}</library_geometries><library_nodes>{nodes}</library_nodes>"
        f'<library_visual_scenes><visual_scene id="s">{scene}</visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )


def tenfold(levels: int, leaf: str) -> str:
    """A COLLADA file in which each node of a level has ten of the level below."""
    above = (
        f'<node id="n{level}">' + f'<instance_node url="#n{level - 1}"/>' * 10 + "</node>"
        for level in range(1, levels + 1)
    )
    nodes = "".join([f'<node id="n0">{leaf}</node>', *above])
    return dae(f'<node><instance_node url="#n{levels}"/></node>', nodes)


def gltf(nodes: Sequence[Mapping[str, object]], roots: list[int], count: int = 3) -> str:
    """A glTF file with one triangle, which nodes place."""
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    accessor = {"componentType": 5126, "count": count, "type": "VEC3"} | ({"bufferView": 0} if count == 3 else {})
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": roots}],
            "nodes": nodes,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [accessor],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
            "buffers": [{"byteLength": len(data), "uri": uri}],
        }
    )


def ply(vertices: int, faces: int, size: str = "uchar", rest: bytes = b"") -> bytes:
    """A binary PLY file with the corners of one triangle; `size` is the type of the lengths of lists."""
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {faces}\nproperty list {size} int vertex_indices\nend_header\n"
    )
    return header.encode() + struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + rest


def _sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(20_000_000_000)


VERTICES = b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"
LIMITS, DAMAGED, TRIANGLES = "reading the file takes more than", "damaged", "triangles, more than 1,000,000"
NODES = "the scene has more than 200,000 nodes, counted in all their places"

HOSTILE: dict[str, tuple[str | bytes | Callable[[Path], str | bytes | None], str]] = {
    "expression.off": ("OFF" + "#" * 60 + "\n", DAMAGED),
    "corners.off": (lambda _: "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9000000 " + "0 1 2 " * 3_000_000, LIMITS),
    "reference.dae": (dae('<node><instance_geometry url="#nothing"/></node>'), "#nothing"),
    "source.dae": (dae(geometry=TRIANGLE.replace('source="#p"', 'source="#nothing"')), DAMAGED),
    "scene.dae": (dae().replace('url="#s"', 'url="#nothing"'), "#nothing"),
    "itself.dae": (
        dae('<node><instance_node url="#n"/></node>', '<node id="n"><instance_node url="#n"/></node>'),
        "#n",
    ),
    "bytes.dae": (bytes(range(256)) * 20, "well-formed"),
    "deep.dae": (lambda _: dae("<node>" * 100_000 + "</node>" * 100_000), "well-formed"),
    "offset.dae": (dae(geometry=TRIANGLE.replace('offset="0"', 'offset="999999999"')), DAMAGED),
    "tenfold.dae": (tenfold(11, ""), NODES),
    "announced.ply": (ply(3, 4_000_000_000), "no triangles"),
    "vertices.ply": (ply(4_000_000_000, 1), DAMAGED),
    "list.ply": (ply(3, 1, "uint", struct.pack("<I", 4_000_000_000)), DAMAGED),
    "long.ply": (lambda _: ply(3, 1, "uint", struct.pack("<I", 4_000_000) + bytes(16_000_000)), TRIANGLES),
    "negative.ply": (ply(3, 1, "int", struct.pack("<i", -5)), DAMAGED),
    "bytes.glb": (b"glTF" + bytes(range(256)) * 20, DAMAGED),
    "deep.gltf": (lambda _: "[" * 1_000_000, DAMAGED),
    "children.gltf": (lambda _: gltf([{"children": [n + 1]} for n in range(100_000)] + [{"mesh": 0}], [0]), LIMITS),
    "many.gltf": (lambda _: gltf([{"mesh": 0}] * 200_000, list(range(200_000))), LIMITS),
    "accessor.gltf": (gltf([{"mesh": 0}], [0], 400_000_000), LIMITS),
    "corners.obj": (lambda _: VERTICES + b"f " + b"1 2 3 " * 1_500_000, TRIANGLES),
    "lines.obj": (lambda _: b"\n" * 40_000_000, f"{LIMITS}|no triangles"),
    "corners.stl": (lambda _: b"solid a\n" + b"vertex " * 6_000_000 + b"\nendsolid a\n", f"{LIMITS}|no triangles"),
    "triangles.stl": (lambda _: bytes(80) + struct.pack("<I", 1_500_000) + bytes(75_000_000), f"{LIMITS}|{TRIANGLES}"),
    "sparse.stl": (_sparse, "more than 100,000,000 bytes"),
    "sparse.dae": (_sparse, "more than 100,000,000 bytes"),
    "pipe.obj": (os.mkfifo, "not a regular file"),
}
"""By name: the content, or a function that makes content or file (large contents are not kept); the finding."""


def write_hostile(folder: Path, name: str) -> None:
    """Write one of the hostile files."""
    made, _ = HOSTILE[name]
    content = made(folder / name) if callable(made) else made
    if content is not None:
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
