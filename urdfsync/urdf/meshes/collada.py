"""The triangles of a COLLADA file (.dae), placed by its scene, in metres.

Of the metadata, `<unit>` is applied and `<up_axis>` is not. RViz treats the meshes of a URDF so, and
neither MoveIt nor Gazebo classic turns them, which is what exporters count on (ros-visualization/rviz
issue 1045 and `getMeshUnitRescale`, moveit/geometric_shapes pull request 52, gazebosim/gazebo-classic
issue 1305). The transformations of the scene's nodes are applied.
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping

import numpy as np
from lxml import etree
from trimesh.exchange.dae import load_collada

from urdfsync.urdf.meshes.geometry import Triangles, placed
from urdfsync.urdf.meshes.materials import Color, collada_colors, unbound_materials
from urdfsync.urdf.meshes.process import MeshError

_NO_SHAPE = (
    "library_animations",
    "library_animation_clips",
    "library_cameras",
    "library_controllers",
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
"""Elements without influence on the shape. They are taken out: a fault in one of them is none of the mesh."""
_NOT_READ = {"skew": "skewed nodes", "ph": "polygons with holes"}
_MOVES = ("lookat", "matrix", "rotate", "scale", "translate")


def collada_parts(
    content: bytes, others: Mapping[str, bytes] | None = None, missing: list[str] | None = None
) -> Iterator[tuple[Color | None, Triangles]]:
    """Yield the triangles of each geometry where the scene has it, in metres. Raises MeshError.

    With their colours, if `others` has the textures; else without. `missing` gets in words which colours there are not.
    """
    root = _parse(content)
    unit = _unit(root)
    for tag, name in _NOT_READ.items():
        if root.find(f".//{{*}}{tag}") is not None:
            raise MeshError(f"it has {name}, which urdfsync doesn't read")
    if any("-" in (indices.text or "") for indices in root.iter("{*}p")):  # which numpy counts from the end
        raise MeshError("one of its faces has an index that no vertex has")
    _place_skins(root)
    colors: Mapping[etree._Element, Mapping[str, Color]] = {}
    if others is not None and missing is not None:
        by_name, without = collada_colors(root, others)
        colors = _bound_colors(root, by_name)
        missing += [*without, *unbound_materials(root, by_name)]
    etree.strip_elements(root, *(f"{{*}}{tag}" for tag in _NO_SHAPE), with_tail=False)
    _bind(root, colors)
    _move_once_per_node(root)
    shapes = io.BytesIO(etree.tostring(root))
    del root  # pycollada parses them into a tree of its own
    # not by `load_scene`: it would merge vertices, and leave out triangles that are not finite
    loaded = load_collada(shapes, ignore_broken=False)
    for node in loaded["graph"]:
        mesh = loaded["geometry"][node["geometry"]]
        points, faces = placed(Triangles(mesh["vertices"].astype(np.float64), mesh["faces"]), node["matrix"])
        material = mesh["visual"].material if mesh["visual"] else None
        color = tuple(material.baseColorFactor[:3].tolist()) if material else None
        yield color, Triangles(unit * points, faces)


def _bound_colors(root: etree._Element, colors: Mapping[str, Color | None]) -> dict[etree._Element, dict[str, Color]]:
    """Return the colours that each use of a geometry gives to the materials that its primitives name."""
    found = dict[etree._Element, dict[str, Color]]()
    for instance in root.iter("{*}instance_geometry"):
        bound = {one.get("symbol", ""): one.get("target", "") for one in instance.iter("{*}instance_material")}
        known = {symbol: colors.get(target.removeprefix("#")) for symbol, target in bound.items()}
        found[instance] = {symbol: color for symbol, color in known.items() if color}
    return found


def _bind(root: etree._Element, bound: Mapping[etree._Element, Mapping[str, Color]]) -> None:
    """Give the uses of geometries these colours, by materials that have nothing else."""
    space = str(root.tag).removesuffix("COLLADA")

    def add(parent: etree._Element, path: str, **attributes: str) -> etree._Element:
        *outer, last = path.split("/")
        for tag in outer:
            parent = etree.SubElement(parent, f"{space}{tag}")
        return etree.SubElement(parent, f"{space}{last}", attributes)

    used = dict.fromkeys(color for one in bound.values() for color in one.values())
    numbers = {color: number for number, color in enumerate(used)}
    if not numbers:
        return
    effects, materials = add(root, "library_effects"), add(root, "library_materials")
    for color, number in numbers.items():
        effect = add(effects, "effect", id=f"urdfsync-effect{number}")
        diffuse = add(add(effect, "profile_COMMON"), "technique", sid="common")
        add(diffuse, "lambert/diffuse/color").text = " ".join(repr(part / 255) for part in (*color, 255))
        material = add(materials, "material", id=f"urdfsync-material{number}")
        add(material, "instance_effect", url=f"#urdfsync-effect{number}")
    for instance, colors in bound.items():
        common = add(instance, "bind_material/technique_common")
        for symbol, color in colors.items():
            add(common, "instance_material", symbol=symbol, target=f"#urdfsync-material{numbers[color]}")


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


def _place_skins(root: etree._Element) -> None:
    """Put the geometry of each skin where it is bound: trimesh passes over skins."""
    skins = {f"#{one.get('id')}": one[0] for one in root.iterfind("{*}library_controllers/{*}controller")}
    for instance in list(root.iter("{*}instance_controller")):
        skin = skins[instance.get("url", "")]
        space = str(instance.tag).removesuffix("instance_controller")
        node = etree.Element(f"{space}node")
        bind = skin.find("{*}bind_shape_matrix")
        if bind is not None:
            etree.SubElement(node, f"{space}matrix").text = bind.text
        geometry = etree.SubElement(node, f"{space}instance_geometry", url=skin.get("source", ""))
        geometry.extend(instance.iterfind("{*}bind_material"))
        instance.getparent().replace(instance, node)  # type: ignore[union-attr] # the root is none


def _move_once_per_node(root: etree._Element) -> None:
    """Give each transformation a node of its own: pycollada multiplies those of one node in single precision."""
    for node in list(root.iter("{*}node")):
        moves = [child for child in node if etree.QName(child).localname in _MOVES]
        others = [child for child in node if child not in moves]
        inner = node
        for move in moves[1:]:
            inner = etree.SubElement(inner, node.tag)
            inner.append(move)
        inner.extend(others)
