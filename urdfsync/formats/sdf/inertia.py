"""Computes the mass and the inertia of a link from its collisions, as `<inertial auto="true">` asks for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from xml.etree.ElementTree import Element

from urdfsync.formats.sdf.document import SdfDocument
from urdfsync.formats.sdf.frames import Frame, Frames
from urdfsync.formats.urdf.kinematics.poses import IDENTITY, Pose, compose, moved, turned_inertia
from urdfsync.formats.urdf.robot import Inertia

_WATER = 1000.0
"""The density of a shape that states none, in kg/m³."""
_SIZES: Mapping[str, Mapping[str, tuple[float, ...]]] = {
    "box": {"size": (1.0, 1.0, 1.0)},
    "sphere": {"radius": (1.0,)},
    "ellipsoid": {"radii": (1.0, 1.0, 1.0)},
    "cylinder": {"radius": (1.0,), "length": (1.0,)},
    "capsule": {"radius": (0.5,), "length": (1.0,)},
}
"""The sizes of each shape, with their defaults; URDF has them by the same names."""
_PLACES = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
_DECIMALS = 15


def automatic_inertia(frames: Frames, link: Frame, inertial: Element) -> tuple[float, Pose, dict[str, float]]:
    """Return mass, pose of the centre of mass in the link, and inertia in the link's axes. Raises TranslationError.

    With a `<mass>`, the inertia is scaled to it.
    """
    document, usual = frames.document, frames.document.number(inertial, "density", _WATER)
    total, centre = 0.0, [0.0, 0.0, 0.0]
    # the integrals of x·x, x·y and so on add up; the inertia follows from their sum
    products = dict.fromkeys(_PLACES.values(), 0.0)
    for collision in link.element.iterfind("collision"):
        given_in = frames.given_in(link.scope, collision, link)
        pose = compose(frames.pose(given_in, link), document.pose(collision))
        volume, (xx, yy, zz), height = _shape(document, collision)
        mass, place = volume * document.number(collision, "density", usual), moved(pose, (0.0, 0.0, height))
        squares = turned_inertia(pose[0], Inertia(xx, iyy=yy, izz=zz))
        total += mass
        centre = [sum_ + mass * value for sum_, value in zip(centre, place, strict=True)]
        for i, j in products:
            products[i, j] += mass * (squares[i][j] + place[i] * place[j])
    if total <= 0.0:
        raise document.fault(inertial, f"link {link.name!r} has no collision with a volume to compute its inertia from")
    x, y, z = (value / total for value in centre)
    given, middle = document.number(inertial, "mass", total), (x, y, z)
    about = {(i, j): (value - total * middle[i] * middle[j]) * given / total for (i, j), value in products.items()}
    trace = about[0, 0] + about[1, 1] + about[2, 2]
    moments = {name: (trace if i == j else 0.0) - about[i, j] for name, (i, j) in _PLACES.items()}
    return given, (IDENTITY[0], middle), {name: round(value, _DECIMALS) for name, value in moments.items()}


def shape_sizes(document: SdfDocument, shape: Element) -> dict[str, tuple[float, ...]]:
    """Return the sizes of a shape by their names; none for a shape that URDF lacks. Raises TranslationError."""
    return {name: document.numbers(shape, name, usual) for name, usual in _SIZES.get(shape.tag, {}).items()}


def _shape(document: SdfDocument, collision: Element) -> tuple[float, tuple[float, float, float], float]:
    """Return volume, mean squares of x, y and z about the centre of mass, and the height of this centre."""
    found = collision.find("geometry/*")
    shape = collision if found is None else found
    match shape.tag, [value for values in shape_sizes(document, shape).values() for value in values]:
        case "box", [x, y, z]:
            return x * y * z, (x * x / 12, y * y / 12, z * z / 12), 0.0
        case "sphere", [r]:
            return 4 / 3 * math.pi * r**3, (r * r / 5,) * 3, 0.0
        case "ellipsoid", [x, y, z]:
            return 4 / 3 * math.pi * x * y * z, (x * x / 5, y * y / 5, z * z / 5), 0.0
        case "cylinder", [r, h]:
            return math.pi * r * r * h, (r * r / 4, r * r / 4, h * h / 12), 0.0
        case "cone", _:  # its centre of mass is a quarter of its height above its base
            r, h = (document.number(shape, name, 1.0) for name in ("radius", "length"))
            return math.pi * r * r * h / 3, (3 / 20 * r * r, 3 / 20 * r * r, 3 / 80 * h * h), -h / 4
        case "capsule", [r, h]:
            tube, ball = math.pi * r * r * h, 4 / 3 * math.pi * r**3
            across = (tube * r * r / 4 + ball * r * r / 5) / (tube + ball)
            along = (tube * h * h / 12 + ball * (r * r / 5 + h * h / 4 + 3 / 8 * h * r)) / (tube + ball)
            return tube + ball, (across, across, along), 0.0
    message = f"the inertia of a <{shape.tag}> is not computed"
    raise document.fault(shape, message, "write the link's <mass> and <inertia>")
