"""Robots that are no tree, in a vertical plane: a four-bar, a five-bar, a slider crank, and a spatial four-bar."""

from __future__ import annotations

import math
from typing import Any

from urdfsync.urdf.robot import Inertia, Inertial, Joint, JointType, Limit, Link, Loop, Origin, Robot, Vector

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
ROBOTS = {"FourBar": FOUR_BAR, "FiveBar": FIVE_BAR, "SliderCrank": SLIDER_CRANK, "Spatial": SPATIAL}
