"""COLLADA: unit and scene count, the axis that is called up does not."""

from __future__ import annotations

import pytest
import trimesh
from support.meshes import NODES, dae, tenfold

from urdfsync.formats.urdf.meshes.geometry import Array, bounds
from urdfsync.formats.urdf.meshes.process import MeshError
from urdfsync.formats.urdf.meshes.reading import read_mesh

BOX = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
"""Faces of a box, seen counter-clockwise from outside, with corners counted by x, y, z in binary."""

PLACED = '<node><instance_geometry url="#box"/></node>'


def _box(x: float = 1, y: float = 2, z: float = 3, name: str = "box", extra: str = "") -> str:
    """A box with one corner at the origin."""
    corners = " ".join(f"{x * (n >> 2)} {y * (n >> 1 & 1)} {z * (n & 1)}" for n in range(8))
    faces = " ".join(" ".join(map(str, face)) for face in BOX)
    return f"""
      <geometry id="{name}"><mesh><!-- a comment -->
        <source id="{name}-p"><float_array id="{name}-a" count="24">{corners}</float_array><technique_common>
          <accessor source="#{name}-a" count="8" stride="3">
            <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
          </accessor></technique_common></source>
        <vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/></vertices>
        <polylist count="6" material="steel"><input semantic="VERTEX" source="#{name}-v" offset="0"/>
          <vcount>{"4 " * 6}</vcount><p>{faces}</p></polylist>{extra}
      </mesh></geometry>"""


def _dae(scene: str = PLACED, geometry: str = "", **parts: str) -> bytes:
    head = '<?xml version="1.0" encoding="utf-8"?>\n'
    return (head + dae(f"<!-- a comment -->{scene}", geometry=geometry or _box(), **parts)).encode()


def _read(content: bytes) -> Array:
    """The corners of all triangles."""
    points, faces = read_mesh(".dae", content)
    return points[faces]


def _bounds(content: bytes) -> list[list[float]]:
    return bounds(_read(content).reshape(-1, 3))


def _volume(corners: Array) -> float:
    """Negative if the triangles look inwards."""
    return float(trimesh.triangles.mass_properties(corners).volume)


@pytest.mark.parametrize(("asset", "metres"), [
    ('<unit name="inch" meter="0.0254"/>', 0.0254),
    ('<unit name="millimeter" meter="1e-3"/>', 0.001),
    ('<unit name="meter"/>', 1),
    *((f"<up_axis>{axis}_UP</up_axis>", 1) for axis in "XYZ"),
])  # fmt: skip
def test_the_unit_is_applied_and_the_up_axis_is_not(asset: str, metres: float) -> None:
    assert _bounds(_dae(asset=asset)) == [[0, 0, 0], [metres, 2 * metres, 3 * metres]]


def test_nodes_place_each_of_two_geometries() -> None:
    scene = """
      <node><matrix>0 -1 0 10  1 0 0 20  0 0 1 30  0 0 0 1</matrix><instance_geometry url="#box"/>
        <node><translate>0 0 100</translate><scale>2 2 2</scale><instance_geometry url="#cube"/></node></node>"""
    content = _dae(scene, _box() + _box(1, 1, 1, "cube"), asset='<unit meter="0.1"/>')
    corners = _read(content)
    assert corners.shape == (24, 3, 3)
    assert bounds(corners[:12].reshape(-1, 3)) == [pytest.approx([0.8, 2, 3]), pytest.approx([1, 2.1, 3.3])]
    assert bounds(corners[12:].reshape(-1, 3)) == [pytest.approx([0.8, 2, 13]), pytest.approx([1, 2.2, 13.2])]
    assert _volume(corners) == pytest.approx((6 + 8) / 1000)


def test_node_of_the_library_is_placed_where_it_is_instanced() -> None:
    part = f'<node id="part"><translate>1 0 0</translate>{PLACED}</node>'
    content = _dae('<node><translate>0 7 0</translate><instance_node url="#part"/></node>', nodes=part)
    assert _bounds(content) == [[1, 7, 0], [2, 9, 3]]


@pytest.mark.parametrize("levels", [6, 20, 2_000])
def test_instances_in_instances_are_counted_before_they_are_placed(levels: int) -> None:
    with pytest.raises(MeshError, match=NODES):
        _read(tenfold(levels, '<instance_geometry url="#g"/>').encode())


def test_a_scene_may_have_thousands_of_instances() -> None:
    assert len(_read(tenfold(3, '<instance_geometry url="#g"/>').encode())) == 1_000


def test_a_node_in_itself_is_named() -> None:
    inner = '<node id="n"><node><instance_node url="#n"/></node></node>'
    with pytest.raises(MeshError, match="node #n has an instance of itself"):
        _read(_dae('<node><instance_node url="#n"/></node>', nodes=inner))


def test_skin_stands_as_it_is_bound() -> None:
    def source(name: str, array: str, kind: str, parameter: str) -> str:
        accessor = (
            f'<accessor source="#{name}-a" count="1" stride="1"><param name="{parameter}" type="{kind}"/></accessor>'
        )
        return f'<source id="{name}">{array}<technique_common>{accessor}</technique_common></source>'

    bind = "1 0 0 4  0 1 0 5  0 0 1 6  0 0 0 1"
    skin = f"""<library_controllers><controller id="skin"><skin source="#box">
      <bind_shape_matrix>{bind}</bind_shape_matrix>
      {source("j", '<Name_array id="j-a" count="1">bone</Name_array>', "name", "JOINT")}
      {source("m", f'<float_array id="m-a" count="16">{bind}</float_array>', "float4x4", "TRANSFORM")}
      {source("w", '<float_array id="w-a" count="1">1</float_array>', "float", "WEIGHT")}
      <joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#m"/></joints>
      <vertex_weights count="8"><input semantic="JOINT" source="#j" offset="0"/>
        <input semantic="WEIGHT" source="#w" offset="1"/><vcount>{"1 " * 8}</vcount><v>{"0 0 " * 8}</v>
      </vertex_weights></skin></controller></library_controllers>"""
    content = _dae('<node><instance_controller url="#skin"/></node>', libraries=skin)
    assert _bounds(content) == [[4, 5, 6], [5, 7, 9]]


@pytest.mark.parametrize(("content", "reason"), [
    (b"", "well-formed"),
    (b"solid a\nendsolid a\n", "well-formed"),
    (_dae()[:900], "well-formed"),
    (b"<a/>", "damaged"),
    (b"<!DOCTYPE a [<!ENTITY e 'e'>]><a>&e;</a>", "document type"),
    (_dae(asset='<unit meter="inch"/>'), "'inch' metres"),
    (_dae(asset='<unit meter="0"/>'), "'0' metres"),
    (_dae(asset='<unit meter="nan"/>'), "'nan' metres"),
    (_dae('<node><instance_geometry url="#other"/></node>'), "#other"),
    (_dae('<node><instance_geometry url="other.dae#box"/></node>'), "other.dae#box"),
    (_dae('<node><instance_geometry url="#box"/><instance_node url="#other"/></node>'), "#other"),
    (_dae("<node><skew>1 0 0 0 1 0 0</skew></node>"), "skewed"),
    (_dae().replace(b"<polylist", b"<polygons><ph><p/><h/></ph></polygons><polylist"), "holes"),
    (_dae().replace(b"<p>0 1 3 2", b"<p>0 1 3 8"), "index"),
    (_dae().replace(b"<p>0 1 3 2", b"<p>0 1 3 -2"), "index"),
    (_dae().replace(b"<p>0 1 3 2", b"<p>0 1 3 x"), "index"),
    (_dae().replace(b"<p>0 1 3 2", b"<p>0 1 3"), "damaged"),
    (_dae().replace(b'offset="0"', b""), "damaged"),
    (_dae().replace(b">0 0 0", b">0 0 x"), "float array|to its end"),
])  # fmt: skip
def test_what_cannot_be_read_is_said(content: bytes, reason: str) -> None:
    with pytest.raises(MeshError, match=reason):
        _read(content)
