"""The library's own links and joints: the templates of generated ones, with a record that can be replaced."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from urdfsync.domain import Artifact, Import, Order, Role
from urdfsync.formats.urdf.meshes.lookup import key
from urdfsync.formats.urdf.model.joint import joint_model
from urdfsync.formats.urdf.model.numbers import shape_part
from urdfsync.formats.urdf.model.shapes import link_model, link_shapes
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Dynamics,
    Ellipsoid,
    Geometry,
    Joint,
    JointType,
    Limit,
    Link,
    Mesh,
    Sphere,
    Visual,
    effective,
)

MESH = Mesh("robots/six_axis_arm/meshes/base_casting.stl")
IMPORTS = {key(MESH): Import(f"Resources/{MESH.filename}", "", "", {"bounds": ((0, 0, 0), (0, 0, 0)), "hull": ()})}
SHAPES: tuple[Geometry, ...] = (
    Box((0.1, 0.1, 0.1)),
    Cylinder(radius=0.05, length=0.1),
    Capsule(radius=0.05, length=0.1),
    Sphere(radius=0.05),
    Ellipsoid((0.05, 0.05, 0.1)),
    MESH,
)
JOINT_NOTES: Mapping[JointType, str] = {
    "fixed": "Two links that do not move relative to each other.",
    "continuous": "Turns without end stops.",
    "revolute": "Turns within limits.",
    "prismatic": "Slides within limits.",
    "planar": "Slides in a plane and turns about its normal. It has no flanges: its motion is free.",
    "floating": "Moves freely.",
    "ball": "Turns in all directions. It has no flanges: its motion is free.",
}
EVERY_NUMBER = Dynamics(**dict.fromkeys(Dynamics.__struct_fields__, 0.0))
RECORD_NOTE = "The numbers are those of the record <code>parameters</code>, which can be redeclared."


def library_artifacts() -> Iterator[Artifact | Order]:
    """All files of `UrdfSync.Links` and `UrdfSync.Joints` except their `package.mo`."""
    names = [f"{type(shape).__name__}Link" for shape in SHAPES]
    yield Order("Links/package.order", ("Link", *(n for name in names for n in (name, f"{name}Parameters"))))
    yield from link_files("Link", "UrdfSync.Records.Link", Link(""), "Rigid body without a shape.")
    for name, shape in zip(names, SHAPES, strict=True):
        link = Link("", visuals=(Visual(shape),), collisions=(Collision(shape),))
        kind = type(shape).__name__.lower()
        kind = f"an {kind}" if kind[0] in "aeiou" else f"a {kind}"
        yield from link_files(name, f"{name}Parameters", link, f"Rigid body with {kind} as visual and as collision.")
    yield Order("Joints/package.order", (*(kind.capitalize() for kind in JOINT_KINDS), "Loop"))
    for joint in JOINT_KINDS:
        name, note = joint.capitalize(), f"{JOINT_NOTES[joint]} {RECORD_NOTE}"
        data = named_data("Joints", name, f"UrdfSync.Records.{name}Joint")
        full = effective(Joint("", joint, "", "", limit=Limit(acceleration=0.0), dynamics=EVERY_NUMBER))
        data |= joint_model(full, Options(), is_driven=False) | {"note": note}
        template = f"joint/{'axis' if JOINT_KINDS[joint].motion else joint}.mo.jinja"
        yield Artifact(f"Joints/{name}.mo", Role.MODEL, template, data, name)
    note = f"Holds a frame of one link at a frame of another one, and so closes a loop. {RECORD_NOTE}"
    data = named_data("Joints", "Loop", "UrdfSync.Records.Loop") | {"title": "joint that closes a loop", "note": note}
    yield Artifact("Joints/Loop.mo", Role.MODEL, "joint/loop.mo.jinja", data, "Loop")


def link_files(name: str, record: str, link: Link, note: str) -> Iterator[Artifact]:
    visuals, collisions = link_shapes(link, IMPORTS, "UrdfSync", Options())
    named = named_data("Links", name, record)
    if visuals:
        data: dict[str, Any] = {
            "numbers": {},
            "visuals": list(map(shape_part, visuals)),
            "collisions": list(map(shape_part, collisions)),
            "contact": {},
        }
        yield Artifact(f"Links/{record}.mo", Role.RECORD, "link/record.mo.jinja", named | data, name)
    data = link_model(visuals, collisions) | {"note": f"{note} {RECORD_NOTE}"}
    yield Artifact(f"Links/{name}.mo", Role.MODEL, "link/model.mo.jinja", named | data, name)


def named_data(package: str, name: str, record: str) -> dict[str, Any]:
    word = package[:-1].lower()
    kind = name.removesuffix("Link").lower()
    title = f"{kind} {word}" if kind else word
    return {"within": f"UrdfSync.{package}", "type": name, "record": record, "title": title}
