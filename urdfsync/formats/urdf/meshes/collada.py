"""The triangles of a COLLADA file (.dae) at their places in the scene, in metres.

As in RViz, the file's `<unit>` has an effect, but its `<up_axis>` has none (ros-visualization/rviz issue 1045 and
`getMeshUnitRescale`). MoveIt and Gazebo classic also ignore `<up_axis>`, and exporters rely on this
(moveit/geometric_shapes pull request 52, gazebosim/gazebo-classic issue 1305).
"""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter

import numpy as np
from lxml import etree
from trimesh.exchange.dae import load_collada

from urdfsync.formats.urdf.meshes.geometry import Triangles, placed
from urdfsync.formats.urdf.meshes.materials import Color, effect_color
from urdfsync.formats.urdf.meshes.process import MeshError

_NO_SHAPE = (
    "library_animations",
    "library_animation_clips",
    "library_cameras",
    "library_controllers",
    "library_images",
    "library_lights",
    "asset",
    "extra",
    "instance_camera",
    "instance_light",
    "linestrips",
)
"""Elements without influence on the shape, which are removed together with their faults."""
_MATERIALS = ("library_effects", "library_materials", "bind_material")
_NOT_READ = {"skew": "skewed nodes", "ph": "polygons with holes"}
_NONE = (0, 0, 0, 0)
_MOST_PARTS = 200_000
"""The greatest number of nodes and geometries of a scene: a build's limit of time suffices for about so many."""
_MOVES = ("lookat", "matrix", "rotate", "scale", "translate")


def collada_parts(
    content: bytes, others: Mapping[str, bytes] | None = None
) -> Iterator[tuple[Color | None, Triangles]]:
    """Yield the triangles of each geometry at its places in the scene, in metres. Raises MeshError.

    `others` has the textures; without `others`, triangles have no colours.
    """
    root = _parse(content)
    unit = _unit(root)
    for tag, name in _NOT_READ.items():
        if root.find(f".//{{*}}{tag}") is not None:
            raise MeshError(f"the file has {name}, which urdfsync doesn't read")
    if any("-" in (indices.text or "") for indices in root.iter("{*}p")):  # numpy counts negative indices from the end
        raise MeshError("a face has an index that no vertex has")
    _place_skins(root)
    if others is not None:
        _leave_plain_colors(root, others)
    without = _NO_SHAPE if others is not None else _NO_SHAPE + _MATERIALS
    etree.strip_elements(root, *(f"{{*}}{tag}" for tag in without), with_tail=False)
    if _count_parts(root) > _MOST_PARTS:
        raise MeshError(f"the scene has more than {_MOST_PARTS:,} nodes, counted in all their places")
    _move_once_per_node(root)
    shapes = io.BytesIO(etree.tostring(root))
    del root  # frees memory: pycollada builds another tree.
    # `load_scene` would merge vertices and drop infinite triangles
    loaded = load_collada(shapes, ignore_broken=False)
    for node in loaded["graph"]:
        mesh = loaded["geometry"][node["geometry"]]
        points, faces = placed(Triangles(mesh["vertices"].astype(np.float64), mesh["faces"]), node["matrix"])
        red, green, blue, opacity = mesh["visual"].material.baseColorFactor.tolist() if mesh["visual"] else _NONE
        yield (red, green, blue) if opacity else None, Triangles(unit * points, faces)


def _leave_plain_colors(root: etree._Element, textures: Mapping[str, bytes]) -> None:
    """Reduce each effect to its colour, and remove references to missing effects and materials.

    The reduction removes all other faults of effects. An effect without a colour becomes transparent.
    """
    space = str(root.tag).removesuffix("COLLADA")
    images = {image.get("id", ""): image for image in root.iterfind("{*}library_images/{*}image")}
    references = set()
    for effect in root.iterfind("{*}library_effects/{*}effect"):
        color = effect_color(effect, images, textures)
        numbers = (*(part / 255 for part in color), 1.0) if color else _NONE
        part, identifier = effect, effect.get("id", "")
        effect.clear()
        effect.set("id", identifier)
        for tag in ("profile_COMMON", "technique", "lambert", "diffuse", "color"):
            part = etree.SubElement(part, f"{space}{tag}", {"sid": "common"} if tag == "technique" else {})
        part.text = " ".join(map(repr, numbers))
        references.add(f"#{identifier}")
    for user, path, attribute in (("material", "{*}instance_effect", "url"), ("instance_material", ".", "target")):
        for element in list(root.iter(f"{{*}}{user}")):
            reference = element.find(path)
            if reference is not None and reference.get(attribute) in references:
                del reference[:]
                references.add(f"#{element.get('id')}")
            elif (parent := element.getparent()) is not None:
                parent.remove(element)


def _parse(content: bytes) -> etree._Element:
    """Parse a document, and leave out its comments.

    A document type is refused: its entities could grow without limit.
    """
    if b"<!DOCTYPE" in content:
        raise MeshError("the file has a document type declaration, which COLLADA does not allow")
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True, huge_tree=True
    )
    try:
        return etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        raise MeshError(f"the file isn't well-formed XML: {error.msg}") from error


def _unit(root: etree._Element) -> float:
    """Return the file's unit of length in metres; 1 if the file states none."""
    node = root.find("{*}asset/{*}unit")
    text = "1" if node is None else node.get("meter", "1")
    try:
        unit = float(text)
    except ValueError:
        unit = math.nan
    if not (math.isfinite(unit) and unit > 0):
        raise MeshError(f"the unit of length is {text!r} metres")
    return unit


def _place_skins(root: etree._Element) -> None:
    """Put the geometry of each skin in its place in the scene, since trimesh ignores skins."""
    skins = {f"#{skin.get('id')}": skin[0] for skin in root.iterfind("{*}library_controllers/{*}controller")}
    for instance in list(root.iter("{*}instance_controller")):
        skin = skins[instance.get("url", "")]
        space = str(instance.tag).removesuffix("instance_controller")
        node = etree.Element(f"{space}node")
        bind = skin.find("{*}bind_shape_matrix")
        if bind is not None:
            etree.SubElement(node, f"{space}matrix").text = bind.text
        geometry = etree.SubElement(node, f"{space}instance_geometry", url=skin.get("source", ""))
        geometry.extend(instance.iterfind("{*}bind_material"))
        instance.getparent().replace(instance, node)  # type: ignore[union-attr] # only the root has no parent


def _count_parts(root: etree._Element) -> int:
    """Return the number of nodes and geometries of the largest scene, at most `_MOST_PARTS` + 1.

    Nodes count in each place. A few nodes with instances of each other have more places than a computer can visit.
    """
    nodes = {f"#{node.get('id')}": node for node in root.iter("{*}node")}
    children = {
        parent: [nodes.get(part.get("url", ""), part) if _is_instance(part) else part for part in parent]
        for parent in root.iter("{*}visual_scene", "{*}node")
    }
    counts = dict[etree._Element, int]()
    try:
        for part in TopologicalSorter(children).static_order():
            count = 1 + sum(counts[child] for child in children.get(part, ()))
            counts[part] = min(count, _MOST_PARTS + 1)  # integers of unlimited length would take long
    except CycleError as error:
        name = next(node.get("id") for node in error.args[1] if node.get("id"))
        raise MeshError(f"node #{name} has an instance of itself") from error
    return max((counts[scene] for scene in root.iter("{*}visual_scene")), default=0)


def _is_instance(part: etree._Element) -> bool:
    return etree.QName(part).localname == "instance_node"


def _move_once_per_node(root: etree._Element) -> None:
    """Give each transformation its own node: pycollada multiplies those of one node in single precision."""
    for node in list(root.iter("{*}node")):
        moves = [child for child in node if etree.QName(child).localname in _MOVES]
        others = [child for child in node if child not in moves]
        inner = node
        for move in moves[1:]:
            inner = etree.SubElement(inner, node.tag)
            inner.append(move)
        inner.extend(others)
