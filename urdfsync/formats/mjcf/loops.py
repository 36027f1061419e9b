"""Makes loops of the equalities that hold two bodies together.

MuJoCo's constraints give way a little, those of the models do not.
"""

from __future__ import annotations

import mujoco

from urdfsync.formats.mjcf.drives import Drives
from urdfsync.formats.mjcf.robot import Links
from urdfsync.formats.mjcf.turns import rpy
from urdfsync.formats.translation.writer import UrdfElement

_KINDS = {mujoco.mjtEq.mjEQ_CONNECT: "connect", mujoco.mjtEq.mjEQ_WELD: "weld"}
_POINT, _PLACE, _TURN = slice(0, 3), slice(3, 6), slice(6, 10)
"""Places of numbers in an equality: a point in each body, or the pose of the second body in the first one."""


def add_loops(robot: UrdfElement, links: Links, drives: Drives) -> None:
    """Add a loop for each equality of two bodies or two sites; other equalities are left out."""
    scene, model = links.scene, links.scene.model
    for number in range(model.neq):
        kind = mujoco.mjtEq(model.eq_type[number])
        if kind == mujoco.mjtEq.mjEQ_JOINT or not model.eq_active0[number]:
            continue
        if kind not in _KINDS:
            drives.leave_out("equality", "equality", number)
            continue
        first, second = scene.ends(number)
        if first not in links.offsets and second not in links.offsets:
            continue
        if first not in links.offsets or second not in links.offsets:
            drives.leave_out("equality with a body outside of the robot", "equality", number)
            continue
        data = model.eq_data[number]
        if model.eq_objtype[number] == mujoco.mjtObj.mjOBJ_SITE:
            sites = model.eq_obj1id[number], model.eq_obj2id[number]
            places = [(model.site_pos[site], model.site_quat[site]) for site in sites]
        elif _KINDS[kind] == "connect":
            places = [(data[_POINT], (1, 0, 0, 0)), (data[_PLACE], (1, 0, 0, 0))]
        else:
            places = [(data[_PLACE], data[_TURN]), (data[_POINT], (1, 0, 0, 0))]
        name = scene.name("equality", number) or f"{scene.links[first]}_to_{scene.links[second]}"
        line = scene.line("equality", number)
        loop = robot.add("loop_joint", line, name=name, type="spherical" if _KINDS[kind] == "connect" else "fixed")
        for tag, body, (position, quaternion) in zip(("link1", "link2"), (first, second), places, strict=True):
            xyz = links.place(body, position)
            loop.add(tag, link=scene.links[body], xyz=xyz, rpy=rpy(quaternion))
