"""Robots with loops: a four-bar, a five-bar and a slider crank in a vertical plane, and spatial four-bars."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from msgspec.structs import asdict

from urdfsync.formats.urdf.options import LoopFrame, LoopOption
from urdfsync.formats.urdf.robot import Inertia, Inertial, Joint, JointType, Limit, Link, Loop, Origin, Robot, Vector

UPRIGHT: Vector = (math.pi / 2, 0.0, 0.0)
"""Turns x and y into a vertical plane."""


def bar(name: str, mass: float, length: float) -> Link:
    moment = mass * length**2 / 12
    return Link(name, Inertial(mass, Origin((length / 2, 0.0, 0.0)), Inertia(ixx=1e-4, iyy=moment, izz=moment)))


def joint(name: str, kind: JointType, parent: str, child: str, x: float = 0.0, **fields: Any) -> Joint:
    """A joint at a place along the bar of its parent; on the ground its axis z is horizontal."""
    rpy = UPRIGHT if parent == "ground" and kind != "prismatic" else (0.0, 0.0, 0.0)
    return Joint(name, kind, parent, child, Origin((x, 0.0, 0.0), rpy), **{"axis": (0.0, 0.0, 1.0), **fields})


FOUR_BAR = Robot(
    "four_bar",
    (Link("ground"), bar("crank", 0.3, 0.2), bar("coupler", 0.6, 0.6), bar("rocker", 0.4, 0.4)),
    (
        joint("crank_pivot", "continuous", "ground", "crank", start=1.2, actuated=True),
        joint("crank_pin", "continuous", "crank", "coupler", 0.2, start=-0.8),
        joint("rocker_pivot", "continuous", "ground", "rocker", 0.5, start=1.5),
    ),
    loops=(Loop("rocker_pin", "revolute", "coupler", "rocker", Origin((0.6, 0.0, 0.0)), Origin((0.4, 0.0, 0.0))),),
)
FIVE_BAR = Robot(
    "five_bar",
    (
        Link("ground"),
        bar("left_arm", 0.3, 0.2),
        bar("left_rod", 0.4, 0.35),
        bar("right_arm", 0.3, 0.2),
        bar("right_rod", 0.4, 0.35),
    ),
    (
        joint("left_pivot", "continuous", "ground", "left_arm", start=2.0, actuated=True),
        joint("left_pin", "continuous", "left_arm", "left_rod", 0.2, start=-1.0),
        joint("right_pivot", "continuous", "ground", "right_arm", 0.25, start=1.1, actuated=True),
        joint("right_pin", "continuous", "right_arm", "right_rod", 0.2, start=1.0),
    ),
    loops=(Loop("tip", "revolute", "left_rod", "right_rod", Origin((0.35, 0.0, 0.0)), Origin((0.35, 0.0, 0.0))),),
)
SLIDER_CRANK = Robot(
    "slider_crank",
    (Link("ground"), bar("crank", 0.3, 0.1), bar("rod", 0.4, 0.4), Link("piston", Inertial(0.5))),
    (
        joint("crank_pivot", "continuous", "ground", "crank", start=0.7, actuated=True),
        joint("crank_pin", "continuous", "crank", "rod", 0.1, start=-0.8),
        joint("slide", "prismatic", "ground", "piston", axis=(1.0, 0.0, 0.0), limit=Limit(0.0, 1.0), start=0.45),
    ),
    loops=(Loop("wrist_pin", "revolute", "rod", "piston", Origin((0.4, 0.0, 0.0)), Origin(rpy=UPRIGHT)),),
)
SPATIAL = Robot(
    "spatial",
    (
        Link("ground"),
        bar("crank", 0.3, 0.2),
        Link("spider", Inertial(0.05, inertia=Inertia(ixx=1e-4, iyy=1e-4, izz=1e-4))),
        bar("coupler", 0.7, 0.7),
        bar("rocker", 0.4, 0.4),
    ),
    (
        joint("crank_pivot", "continuous", "ground", "crank", start=1.0, actuated=True),
        joint("spider_a", "continuous", "crank", "spider", 0.2, start=-0.7),
        joint("spider_b", "continuous", "spider", "coupler", axis=(0.0, 1.0, 0.0)),
        joint("rocker_pivot", "continuous", "ground", "rocker", 0.6, start=1.1, axis=(0.0, 0.28, 0.96)),
    ),
    loops=(Loop("ball", "ball", "coupler", "rocker", Origin((0.7, 0.0, 0.0)), Origin((0.4, 0.0, 0.0))),),
)
TILTED: Vector = (0.0, 0.28, 0.96)
RINGS = tuple(Link(name, Inertial(0.05, inertia=Inertia(ixx=1e-4, iyy=1e-4, izz=1e-4))) for name in ("ring", "ball"))


def ball(parent: str, child: str, x: float, *starts: float) -> tuple[Joint, ...]:
    """Three joints one after the other, which together form a ball joint."""
    ends = (parent, "ring", "ball", child)
    return tuple(
        joint(f"turn_{name}", "continuous", ends[k], ends[k + 1], 0.0 if k else x, axis=axis, start=starts[k])
        for k, (name, axis) in enumerate({"z": (0.0, 0.0, 1.0), "y": (0.0, 1.0, 0.0), "x": (1.0, 0.0, 0.0)}.items())
    )


HINGE = Robot(
    "hinge",
    (*SPATIAL.links, *RINGS),
    (*SPATIAL.joints[:3], *ball("coupler", "rocker", 0.7, 2.3, 0.0, 0.0)),
    loops=(
        Loop(
            *("rocker_pivot", "revolute", "ground", "rocker"),
            *(Origin((0.6, 0.0, 0.0), UPRIGHT), Origin((0.4, 0.0, 0.0)), TILTED),
        ),
    ),
)
UNIVERSAL = Robot(
    "universal",
    (*(link for link in SPATIAL.links if link.name != "spider"), *RINGS),
    (SPATIAL.joints[0], *ball("crank", "coupler", 0.2, -0.7, 0.0, 0.0), SPATIAL.joints[3]),
    loops=(
        Loop(
            *("yoke", "universal", "coupler", "rocker", Origin((0.7, 0.0, 0.0)), Origin((0.4, 0.0, 0.0))),
            *((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
        ),
    ),
)
WELD = Robot(
    "weld",
    (*FOUR_BAR.links, bar("foot", 0.2, 0.1)),
    (
        *FOUR_BAR.joints[:2],
        joint("rocker_pin", "continuous", "coupler", "rocker", 0.6, start=-2.0),
        joint("rocker_pivot", "continuous", "rocker", "foot", 0.4, start=1.5),
    ),
    loops=(Loop("seam", "fixed", "ground", "foot", Origin((0.5, 0.0, 0.0), UPRIGHT)),),
)
"""Four-bars like the others, closed elsewhere."""
ROBOTS = {
    "FourBar": FOUR_BAR,
    "FiveBar": FIVE_BAR,
    "SliderCrank": SLIDER_CRANK,
    "Spatial": SPATIAL,
    "Universal": UNIVERSAL,
    "Weld": WELD,
    "Hinge": HINGE,
}


def to_urdf(robot: Robot) -> str:
    """The source of a robot without loops and starts."""
    lines = [f'<robot name="{robot.name}">']
    for link in robot.links:
        lines.append(f'<link name="{link.name}">')
        if link.inertial:
            tensor = " ".join(f'{name}="{value!r}"' for name, value in asdict(link.inertial.inertia).items())
            mass = f'<mass value="{link.inertial.mass!r}"/><inertia {tensor}/>'
            lines.append(f"<inertial>{_origin(link.inertial.origin)}{mass}</inertial>")
        lines.append("</link>")
    for each in robot.joints:
        ends = f'<parent link="{each.parent}"/><child link="{each.child}"/>'
        numbers = asdict(each.limit).items() if each.limit else ()
        limit = " ".join(f'{name}="{value!r}"' for name, value in numbers if isinstance(value, float))
        axis = f'{_origin(each.origin)}<axis xyz="{_numbers(each.axis)}"/>{f"<limit {limit}/>" if limit else ""}'
        lines.append(f'<joint name="{each.name}" type="{each.type}">{ends}{axis}</joint>')
    return "\n".join([*lines, "</robot>", ""])


def to_options(robot: Robot) -> dict[str, Any]:
    """The options for such a source: its loops, its start and its drives."""
    loops = [
        LoopOption(
            loop.name,
            loop.kind,
            (
                LoopFrame(loop.parent, loop.origin.xyz, loop.origin.rpy),
                LoopFrame(loop.child, loop.child_origin.xyz, loop.child_origin.rpy),
            ),
            loop.axis,
            loop.child_axis,
        )
        for loop in robot.loops
    ]
    starts = {each.name: each.start for each in robot.joints if each.start is not None}
    driven = tuple(each.name for each in robot.joints if each.actuated)
    return {"loops": tuple(loops), "start": starts, "driven": driven or None}


def _origin(origin: Origin) -> str:
    return f'<origin xyz="{_numbers(origin.xyz)}" rpy="{_numbers(origin.rpy)}"/>'


def _numbers(values: Iterable[float]) -> str:
    return " ".join(map(repr, values))
