"""The library's own link and joint models: the templates of generated ones, with a record that can be replaced."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from urdfsync.domain import Artifact, Import, Order, Role
from urdfsync.urdf.meshes.lookup import key
from urdfsync.urdf.model.shapes import link_model, link_shapes
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    JOINT_KINDS,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Geometry,
    JointType,
    Link,
    Mesh,
    Sphere,
    Visual,
)

_MESH = Mesh("robots/six_axis_arm/meshes/base_casting.stl")
_IMPORTS = {
    key(_MESH): Import(f"Resources/{_MESH.filename}", "", "", 0, {"bounds": ((0, 0, 0), (0, 0, 0)), "hull": ()})
}

_SHAPES: tuple[Geometry, ...] = (
    Box((0.1, 0.1, 0.1)),
    Cylinder(radius=0.05, length=0.1),
    Capsule(radius=0.05, length=0.1),
    Sphere(radius=0.05),
    _MESH,
)

_JOINT_NOTES: Mapping[JointType, str] = {
    "fixed": "Two links that do not move relative to each other.",
    "continuous": "Turns without end stops.",
    "revolute": "Turns within limits.",
    "prismatic": "Slides within limits.",
    "planar": "Slides in a plane and turns about its normal. It has no flanges: its motion is free.",
    "floating": "Moves freely.",
}

_RECORD_NOTE = "The numbers are those of the record <code>parameters</code>, which can be redeclared."


def library_artifacts() -> Iterator[Artifact | Order]:
    """All files of `UrdfSync.Links` and `UrdfSync.Joints` but their `package.mo`."""
    names = [f"{type(shape).__name__}Link" for shape in _SHAPES]
    yield Order("Links/package.order", ("Link", *(n for name in names for n in (name, f"{name}Parameters"))))
    yield from _link("Link", "UrdfSync.Records.Link", Link(""), "Rigid body without a shape.")
    for name, shape in zip(names, _SHAPES, strict=True):
        link = Link("", visuals=(Visual(shape),), collisions=(Collision(shape),))
        kind = type(shape).__name__.lower()
        yield from _link(name, f"{name}Parameters", link, f"Rigid body with a {kind} as visual and as collision.")
    yield Order("Joints/package.order", tuple(kind.capitalize() for kind in JOINT_KINDS))
    for kind in JOINT_KINDS:
        yield _joint(kind, _JOINT_NOTES[kind])


def _link(name: str, record: str, link: Link, note: str) -> Iterator[Artifact]:
    visuals, collisions = link_shapes(link, _IMPORTS, "UrdfSync", Options())
    named = _names("Links", name, record)
    if visuals:
        data = {"name": link.name, "inertial": None, "visuals": visuals, "collisions": collisions}
        yield Artifact(f"Links/{record}.mo", Role.RECORD, "link/record.mo.jinja", named | data, name)
    data = link_model(visuals, collisions, Options()) | {"replaceable": True, "note": f"{note} {_RECORD_NOTE}"}
    yield Artifact(f"Links/{name}.mo", Role.MODEL, "link/model.mo.jinja", named | data, name)


def _joint(kind: JointType, note: str) -> Artifact:
    name = kind.capitalize()
    data = _names("Joints", name, f"UrdfSync.Records.{name}Joint")
    data |= {"dynamics": JOINT_KINDS[kind].has_axis, "replaceable": True, "note": f"{note} {_RECORD_NOTE}"}
    return Artifact(f"Joints/{name}.mo", Role.MODEL, f"joint/{kind}.mo.jinja", data, name)


def _names(package: str, name: str, record: str) -> dict[str, Any]:
    word = package[:-1].lower()
    kind = name.removesuffix("Link").lower()
    title = f"{kind} {word}" if kind else word
    return {"within": f"UrdfSync.{package}", "type": name, "record": record, "title": title}
