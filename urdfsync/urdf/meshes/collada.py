"""The triangles of a COLLADA file (.dae), placed by its scene, in metres.

Of the metadata, `<unit>` is applied and `<up_axis>` is not. RViz treats the meshes of a URDF so, and
neither MoveIt nor Gazebo classic turns them, which is what exporters count on (ros-visualization/rviz
issue 1045 and `getMeshUnitRescale`, moveit/geometric_shapes pull request 52, gazebosim/gazebo-classic
issue 1305). The transformations of the scene's nodes are applied.

pycollada does the reading. It drops a geometry whose material, image or neighbour it doesn't understand;
hence all that has no influence on the shape is taken out before, and every fault it then notes counts.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator
from typing import Any

import collada
import numpy as np
from collada import controller, polylist, scene, triangleset
from collada.common import DaeError, DaeUnsupportedError
from lxml import etree

from urdfsync.urdf.meshes.errors import MeshError, damage_is_an_error
from urdfsync.urdf.meshes.geometry import Array, Triangles, joined, placed

_NO_SHAPE = (
    "library_animations",
    "library_animation_clips",
    "library_cameras",
    "library_effects",
    "library_images",
    "library_lights",
    "library_materials",
    "asset",
    "bind_material",
    "extra",
    "instance_camera",
    "instance_light",
    "linestrips",
)
_NOT_READ = {"skew": "skewed nodes", "ph": "polygons with holes"}


def read_collada(content: bytes) -> Triangles:
    """Read all triangles, in metres. Raises MeshError."""
    root = _parse(content)
    unit = _unit(root)
    for tag, name in _NOT_READ.items():
        if root.find(f".//{{*}}{tag}") is not None:
            raise MeshError(f"it has {name}, which urdfsync doesn't read")
    etree.strip_elements(root, *(f"{{*}}{tag}" for tag in _NO_SHAPE), with_tail=False)
    shapes = etree.tostring(root)
    del root  # pycollada parses them into a tree of its own
    with damage_is_an_error():
        mesh = joined(part for node in _scene(shapes).nodes for part in _triangles(node, np.identity(4)))
        return Triangles(unit * mesh.points, mesh.faces)


def _parse(content: bytes) -> etree._Element:
    """The document without comments. A document type is refused: entities could make it grow without end."""
    if b"<!DOCTYPE" in content:
        raise MeshError("it has a document type declaration, which COLLADA files don't have")
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True, huge_tree=True
    )
    try:
        return etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        raise MeshError(f"it isn't well-formed XML: {error.msg}") from error


def _unit(root: etree._Element) -> float:
    """Metres per unit of length, 1 unless the file says otherwise."""
    node = root.find("{*}asset/{*}unit")
    text = "1" if node is None else node.get("meter", "1")
    try:
        unit = float(text)
    except ValueError:
        unit = math.nan
    if not (math.isfinite(unit) and unit > 0):
        raise MeshError(f"its unit of length is {text!r} metres")
    return unit


def _scene(content: bytes) -> Any:
    """The scene as pycollada's object. What it can't make sense of is an error, what it doesn't know is not."""
    document = collada.Collada(io.BytesIO(content), ignore=[DaeError])
    if not all(isinstance(fault, DaeUnsupportedError) for fault in document.errors):
        raise MeshError(f"its content isn't consistent: {document.errors[0]}")
    if document.scene is None:
        raise MeshError("it has no scene")
    return document.scene


def _triangles(node: Any, pose: Array) -> Iterator[Triangles]:
    """The triangles at and below a node of pycollada's scene; `pose` (4 × 4) is that of the parent."""
    if isinstance(node, scene.NodeNode):
        yield from _triangles(node.node, pose)
    elif isinstance(node, scene.Node):
        for transformation in node.transforms:
            pose = _product(pose, transformation.matrix)
        for child in node.children:
            yield from _triangles(child, pose)
    elif isinstance(node, scene.GeometryNode):
        yield from _primitives(node.geometry, pose)
    elif isinstance(node, scene.ControllerNode) and isinstance(node.controller, controller.Skin):
        yield from _primitives(node.controller.geometry, _product(pose, node.controller.bind_shape_matrix))
    elif isinstance(node, scene.ControllerNode):
        yield from _primitives(node.controller.source_geometry, pose)


def _primitives(geometry: Any, pose: Array) -> Iterator[Triangles]:
    """The triangles of one geometry at a pose; lines are left out."""
    for primitive in geometry.primitives:
        part = primitive.triangleset() if isinstance(primitive, polylist.Polylist) else primitive
        if isinstance(part, triangleset.TriangleSet) and part.vertex is not None:
            yield placed(Triangles(part.vertex.astype(np.float64), part.vertex_index), pose)


def _product(first: Array, second: Array) -> Array:
    """Matrix product (4 × 4) in double precision and a fixed order of operations, the same on every machine."""
    product: Array = (first[:, :, np.newaxis] * second.astype(np.float64)[np.newaxis]).sum(axis=1)
    return product
