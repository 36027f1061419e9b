"""The library's own link and joint models: the templates of generated ones, with a record that can be replaced."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping

from urdfsync.domain import Artifact, Import, Order, Role, Target
from urdfsync.urdf.artifacts import LINK_MODEL, LINK_RECORD, joint_data, joint_model, link_data
from urdfsync.urdf.meshes.lookup import key
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Dynamics,
    Geometry,
    Joint,
    JointType,
    Link,
    Mesh,
    Sphere,
    Visual,
)
from urdfsync.urdf.skeleton import MOTIONS

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
    yield _link("Link", "UrdfSync.Records.Link", Link(""), "Rigid body without a shape.")
    for name, shape in zip(names, _SHAPES, strict=True):
        link = Link("", visuals=(Visual(shape),), collisions=(Collision(shape),))
        kind = type(shape).__name__.lower()
        model = _link(name, f"{name}Parameters", link, f"Rigid body with a {kind} as visual and as collision.")
        yield dataclasses.replace(model, path=f"Links/{name}Parameters.mo", role=Role.RECORD, template=LINK_RECORD)
        yield model
    yield Order("Joints/package.order", tuple(kind.capitalize() for kind in _JOINT_NOTES))
    for kind, note in _JOINT_NOTES.items():
        yield _joint(kind, note)


def _link(name: str, record: str, link: Link, note: str) -> Artifact:
    data = link_data(link, _IMPORTS, Target("UrdfSync", ""), Options())
    data |= {
        "within": "UrdfSync.Links",
        "type": name,
        "record": record,
        "replaceable": True,
        "title": "link" if name == "Link" else f"{name.removesuffix('Link').lower()} link",
        "note": f"{note} {_RECORD_NOTE}",
    }
    return Artifact(f"Links/{name}.mo", Role.MODEL, LINK_MODEL, data, name)


def _joint(kind: JointType, note: str) -> Artifact:
    name = kind.capitalize()
    moving = kind in MOTIONS or kind == "planar"
    joint = Joint("", kind, "", "", dynamics=Dynamics() if moving else None)
    data = joint_data(joint) | {
        "within": "UrdfSync.Joints",
        "type": name,
        "record": f"UrdfSync.Records.{name}Joint",
        "replaceable": True,
        "title": f"{kind} joint",
        "note": f"{note} {_RECORD_NOTE}",
    }
    return Artifact(f"Joints/{name}.mo", Role.MODEL, joint_model(joint), data, name)
