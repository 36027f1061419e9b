"""Jansen's walking mechanism as a generator of many loops: legs of three loops each on one crankshaft."""

from __future__ import annotations

import math

from urdfsync.formats.urdf.robot import Joint, Link, Loop, Origin, Robot

_Point = tuple[float, float]
_BARS = dict(zip("abcdefgjklm", (38.0, 41.5, 39.3, 40.1, 55.8, 39.4, 36.7, 50.0, 61.9, 7.8, 15.0), strict=True))
"""Jansen's numbers: lengths in cm, `a` and `l` from the crank to the fixed pivot, `m` the crank."""


def strandbeest(legs: int = 12, away: float = 0.1) -> Robot:
    """The mechanism with each joint `away` rad from a closed pose; pairs of legs are mirror images."""
    joints, loops = [Joint("crank", "continuous", "frame", "shaft", axis=(0.0, 0.0, 1.0), actuated=True)], list[Loop]()
    for number in range(legs):
        leg_joints, leg_loops = _leg(str(number), -1 if number % 2 else 1, math.tau * (number // 2) / 3, away)
        joints += leg_joints
        loops += leg_loops
    links = dict.fromkeys(name for joint in joints for name in (joint.parent, joint.child))
    return Robot("strandbeest", tuple(map(Link, links)), tuple(joints), loops=tuple(loops))


def _leg(number: str, side: int, phase: float, away: float) -> tuple[list[Joint], list[Loop]]:
    """One leg: p the pin of the crank, z the fixed pivot, u, v and w the corners around it, x the ankle."""
    bars = _BARS
    at = {"p": (side * bars["m"] * math.cos(phase), bars["m"] * math.sin(phase)), "z": (-bars["a"], -bars["l"])}
    at["u"] = max(_meet(at["z"], bars["b"], at["p"], bars["j"]), key=lambda point: point[1])
    at["v"] = min(_meet(at["z"], bars["c"], at["p"], bars["k"]), key=lambda point: point[1])
    at["w"] = min(_meet(at["z"], bars["d"], at["u"], bars["e"]))
    at["x"] = min(_meet(at["w"], bars["f"], at["v"], bars["g"]), key=sum)
    at = {name: (side * x / 100, y / 100) for name, (x, y) in at.items()}

    def angle(start: str, end: str) -> float:
        return math.atan2(at[end][1] - at[start][1], at[end][0] - at[start][0])

    def bar(start: str, end: str) -> Origin:
        return Origin((math.dist(at[start], at[end]), 0.0, 0.0))

    def joint(name: str, parent: str, child: str, origin: Origin, start: float) -> Joint:
        names = (f"{name}{number}", "continuous", parent, f"{child}{number}")
        return Joint(*names, origin, axis=(0.0, 0.0, 1.0), start=start + away)  # type: ignore[arg-type] # a type of joint

    def pin(name: str, parent: str, child: str, *places: Origin) -> Loop:
        names, z = (f"{parent}{number}", f"{child}{number}"), (0.0, 0.0, 1.0)
        return Loop(f"{name}{number}", "revolute", *names, places[0], places[1], z)

    crank, pivot = Origin((*at["p"], 0.0)), Origin((*at["z"], 0.0))
    turn, corner = angle("z", "w") - angle("z", "u"), math.dist(at["z"], at["w"])
    joints = [
        joint("upper", "shaft", "j", crank, angle("p", "u")),
        joint("lower", "shaft", "k", crank, angle("p", "v")),
        joint("hip", "frame", "plate", pivot, angle("z", "u")),
        joint("rocker", "frame", "c", pivot, angle("z", "v")),
        joint(
            *("knee", f"plate{number}", "f", Origin((corner * math.cos(turn), corner * math.sin(turn), 0.0))),
            angle("w", "x") - angle("z", "u"),
        ),
        joint("ankle", f"c{number}", "foot", bar("z", "v"), angle("v", "x") - angle("z", "v")),
    ]
    pins = [
        pin("pin_u", "j", "plate", bar("p", "u"), bar("z", "u")),
        pin("pin_v", "k", "c", bar("p", "v"), bar("z", "v")),
        pin("pin_x", "f", "foot", bar("w", "x"), bar("v", "x")),
    ]
    return joints, pins


def _meet(a: _Point, to_a: float, b: _Point, to_b: float) -> tuple[_Point, _Point]:
    """The points at these distances from two points."""
    x, y, apart = b[0] - a[0], b[1] - a[1], math.dist(a, b)
    along = (to_a**2 - to_b**2 + apart**2) / 2 / apart
    across = math.sqrt(to_a**2 - along**2)
    first, second = (
        (a[0] + (along * x - side * y) / apart, a[1] + (along * y + side * x) / apart) for side in (across, -across)
    )
    return first, second
