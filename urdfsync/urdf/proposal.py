"""What `init` guesses about a robot."""

from __future__ import annotations

import re

from urdfsync.domain import Proposal
from urdfsync.urdf.naming import natural_key
from urdfsync.urdf.robot import Robot
from urdfsync.urdf.skeleton import Skeleton

_FOOTPRINT = re.compile(r"base_?footprint", re.IGNORECASE)
_WHEEL = re.compile(r"wheel|caster|castor|track(?!er)", re.IGNORECASE)
_LEG = re.compile(r"(?:^|[^a-z])(?:leg|foot|feet|ankle|hip|thigh|calf|shin|toe)(?:$|[^a-z])", re.IGNORECASE)


def propose_base(robot: Robot) -> Proposal:
    """Whether a robot stands on the ground by itself: a guess from names, with the name that decided it."""
    skeleton = Skeleton.of(robot)
    root = skeleton.links[0].name
    if root == "world":
        return Proposal("base", "fixed", 'its root link is named "world"')
    if _FOOTPRINT.search(root):
        return Proposal("base", "floating", f'its root link is named "{root}"')
    moving = {joint.child for joint in robot.joints if joint.type in ("continuous", "revolute")}
    for words, pattern in (("a wheel", _WHEEL), ("a leg", _LEG)):
        found = sorted((name for name in moving if pattern.search(name)), key=natural_key)
        if len(found) > 1:
            return Proposal("base", "floating", f'link "{found[0]}" sounds like {words}')
    return Proposal("base", "fixed", "no link sounds like a wheel or a leg")
