"""Robots as values: small robots from joints, and random robots for property tests."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from random import Random
from typing import Any
from xml.sax.saxutils import quoteattr

import msgspec
from hypothesis import strategies as st

from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    MOTION_KINDS,
    Box,
    Calibration,
    Collision,
    Cylinder,
    Dynamics,
    Geometry,
    Inertia,
    Inertial,
    Joint,
    JointType,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Origin,
    Robot,
    SafetyController,
    Sphere,
    Vector,
    Visual,
)

SCALAR: tuple[JointType, ...] = ("continuous", "revolute", "prismatic")
TYPES: tuple[JointType, ...] = (*SCALAR, "fixed", "planar", "floating", "ball")
NAMES = ("arm", "Arm", "ARM", "arm_link", "arm_joint", "wheel", "leg-1", "leg_1", "leg 1", "Links", "m", "x9", "x10")
"""Names of links and joints, most of which become equal as identifiers."""
FILES = ("a.stl", "b.stl", "c.dae")
Number = Callable[[Random], float]


def tree(*joints: Joint, links: tuple[Link, ...] = ()) -> KinematicTree:
    """Joints and their links in canonical order; links that are not in `links` have only a name."""
    names = {joint.parent: None for joint in joints} | {joint.child: None for joint in joints}
    known = {link.name: link for link in links}
    every = tuple(known.get(name, Link(name)) for name in names) or links
    return KinematicTree.of(Robot("r", every, joints))


def assembly(robot: KinematicTree | Robot, **options: Any) -> Assembly:
    """Return a robot put together, without loops."""
    return Assembly(Robot("r", robot.links, robot.joints, sensors=robot.sensors), Options(**options))


def few(random: Random) -> float:
    """One of few numbers, so that elements are often equal."""
    return random.choice((0.0, 1.0, 2.0))


def any_number(random: Random) -> float:
    """A number that is not large, and often zero."""
    return random.choice((0.0, random.uniform(-3, 3), random.uniform(-3, 3)))


def robots(types: Sequence[JointType] = TYPES, **options: Any) -> st.SearchStrategy[Robot]:
    """Random robots for property tests."""
    return st.randoms(use_true_random=False).map(
        lambda random: random_robot(random, types, number=any_number, **options)
    )


def random_robot(
    random: Random,
    types: Sequence[JointType] = TYPES,
    *,
    number: Number = few,
    mimics: float = 0.4,
    names: Sequence[str] = (),
    reach: int = 10_000,
) -> Robot:
    """A random tree of up to seven links in any order, or of links with these names; joints follow others in chains.

    The share `mimics` of the joints that can follow do. A joint starts at one of the `reach` links before its own.
    """
    links = names or random.sample(NAMES, random.randint(1, 7))
    called = [f"{name}j" for name in names[1:]] or random.sample(NAMES, len(links) - 1)
    joints: dict[str, Joint] = {}
    for place, name in enumerate(called, start=1):
        kind = random.choice(types)
        lower = number(random)
        limit = Limit(lower, lower + random.choice((0.5, 3.0)), 2.0, 1.0) if kind in ("revolute", "prismatic") else None
        parent, axis = links[random.randrange(max(0, place - reach), place)], _unit(_vector(random, number))
        joints[name] = Joint(name, kind, parent, links[place], origin(random, number), axis, limit)
    leaders: list[str] = []
    for name, joint in random.sample(sorted(joints.items()), len(joints)):
        if joint.type in SCALAR and leaders and random.random() < mimics:
            mimic = Mimic(random.choice(leaders), random.choice((-2.0, -0.5, 0.0, 1.0, 3.0)), number(random))
            joints[name] = msgspec.structs.replace(joint, mimic=mimic)
        if joint.type in (*SCALAR, "fixed"):
            leaders.append(name)
    shuffled = random.sample([Link(name) for name in links], len(links))
    return Robot("random", tuple(shuffled), tuple(random.sample(sorted(joints.values(), key=str), len(joints))))


def dressed(robot: Robot, random: Random) -> Robot:
    """The robot with random further elements of URDF."""
    links = tuple(_dressed_link(random, link) for link in robot.links)
    joints = tuple(msgspec.structs.replace(joint, **_blocks(random, joint)) for joint in robot.joints)
    driven, first = [joint.name for joint in joints if joint.type in MOTION_KINDS], links[0].name
    extensions = {"gazebo": f"<gazebo reference={quoteattr(first)}><selfCollide>1</selfCollide></gazebo>"}
    if driven:
        drive = (
            f"<joint name={quoteattr(driven[0])}><hardwareInterface>PositionJointInterface</hardwareInterface></joint>"
        )
        extensions["transmission"] = f'<transmission name="t">{drive}</transmission>'
    tags = {tag: (text,) for tag, text in extensions.items() if random.random() < 0.3}
    return Robot(robot.name, links, joints, {"": tags} if tags else {})


def origin(random: Random, number: Number = few) -> Origin:
    """A random pose."""
    return Origin(_vector(random, number), random.choice(((0.0, 0.0, 0.0), _vector(random, number))))


def _vector(random: Random, number: Number) -> Vector:
    return number(random), number(random), number(random)


def _unit(vector: Vector) -> Vector:
    """The unit vector along a vector; z for a vector of about zero."""
    x, y, z = vector
    length = math.hypot(*vector)
    return (0.0, 0.0, 1.0) if length < 1e-3 else (x / length, y / length, z / length)


def _dressed_link(random: Random, link: Link) -> Link:
    visuals = [Visual(*_shape(random), _material(random)) for _ in range(random.choice((0, 0, 1, 2)))]
    collisions = [Collision(*_shape(random)) for _ in range(random.choice((0, 0, 1, 2)))]
    inertial = random.choice((None, Inertial(1.0, origin(random), Inertia(ixx=1.0, iyy=1.0, izz=1.0))))
    return Link(link.name, inertial, tuple(visuals), tuple(collisions))


def _shape(random: Random) -> tuple[Geometry, Origin, str]:
    meshes: list[Geometry] = [Mesh(file) for file in FILES]
    geometry = random.choice([Box((1.0, 2.0, 3.0)), Sphere(1.0), Cylinder(1.0, 2.0), *meshes, *meshes])
    return geometry, origin(random), random.choice(("", "", "cover"))


def _material(random: Random) -> Material | None:
    red, green = Material("red", (1.0, 0.0, 0.0, 1.0)), Material("red", (0.0, 0.5, 0.0, 1.0))
    return random.choice((None, Material("red"), red, green))


def _blocks(random: Random, joint: Joint) -> dict[str, object]:
    """Random elements of a joint."""
    blocks = {
        "limit": Limit(-1.0, 1.0, random.choice((None, 2.0))),
        "dynamics": Dynamics(0.0, random.choice((0.0, 0.2)), random.choice((None, None, 0.0, 0.1))),
        "calibration": Calibration(random.choice((None, 0.5))),
        "safety_controller": SafetyController(1.0, 1.0),
    }
    return {name: block if random.random() < 0.4 else getattr(joint, name) for name, block in blocks.items()}


# Robots as text


def robot_extensions(robot: Robot) -> list[tuple[str, str, str]]:
    """Owner, tag and text of all elements that are not modelled."""
    return [
        (owner, tag, text) for owner, tags in robot.extensions.items() for tag, texts in tags.items() for text in texts
    ]


def urdf(robot: Robot) -> str:
    """A URDF with all elements of the robot; extensions are at the end of the robot."""
    links = [_element("link", link) for link in robot.links]
    joints = [_element("joint", joint) for joint in robot.joints]
    extensions = [text for _, _, text in robot_extensions(robot)]
    return "\n".join([f'<robot name="{robot.name}">', *links, *joints, *extensions, "</robot>", ""])


_ATTRIBUTES = {"mass": "value", "axis": "xyz", "parent": "link", "child": "link", "rgba": "rgba"}
"""Fields that URDF writes as elements with one attribute."""
_TAGS = {"visuals": "visual", "collisions": "collision", "rgba": "color"}


def _element(tag: str, value: msgspec.Struct) -> str:
    """An element: its fields are attributes, elements with one attribute, or elements with fields of their own."""
    attributes, inside = "", ""
    for name in value.__struct_fields__:
        field, tagged = getattr(value, name), _TAGS.get(name, name)
        if isinstance(field, Geometry):
            inside += f"<geometry>{_element(type(field).__name__.lower(), field)}</geometry>"
        elif isinstance(field, msgspec.Struct):
            inside += _element(tagged, field)
        elif isinstance(field, tuple) and not isinstance((*field, 0.0)[0], float):
            inside += "".join(_element(tagged, one) for one in field)
        elif field is not None and name in _ATTRIBUTES:
            inside += f"<{tagged} {_ATTRIBUTES[name]}={_quoted(field)}/>"
        elif field is not None and name not in ("actuated", "command"):
            attributes += f" {name}={_quoted(field)}"
    return f"<{tag}{attributes}>{inside}</{tag}>"


def _quoted(value: str | float | Vector) -> str:
    if isinstance(value, str):
        return quoteattr(value)
    return quoteattr(" ".join(map(repr, value if isinstance(value, tuple) else (value,))))
