"""Finds what acts on a robot in MuJoCo, and what no model has, and what has no effect on the robot at all."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from urdfsync.mjcf.drives import Drives, OmittedPart
from urdfsync.mjcf.scene import MujocoScene
from urdfsync.translation.writer import UrdfElement

_GRAVITY = (0.0, 0.0, -9.81)
_SWITCHES = ("GRAVITY", "CONSTRAINT", "EQUALITY", "FRICTIONLOSS", "LIMIT", "ACTUATION", "PASSIVE", "SPRING", "DAMPER")
"""What the flags of an option may switch off for all joints, as versions of MuJoCo name it."""
_SOLREF, _SOLIMP = (0.02, 1.0), (0.9, 0.95, 0.001, 0.5, 2.0)
"""MuJoCo's usual softness of a constraint."""
_AT_ONCE = (mujoco.mjtDyn.mjDYN_NONE, mujoco.mjtDyn.mjDYN_INTEGRATOR)
"""Dynamics of actuators without a delay: an integrator of a velocity is a command of the velocity."""
_FREE, _BALL = mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL


def find_left_out(scene: MujocoScene, drives: Drives) -> None:
    """Add to the drives' list what acts on the robot by other means than joints and motors."""
    model = scene.model
    for joint in drives.joints:
        kind, dof = model.jnt_type[joint], model.jnt_dofadr[joint]
        if _any(model, "jnt_stiffnesspoly", joint):
            drives.leave_out("spring that is not linear", "joint", joint, scene.joints[joint])
        elif model.jnt_stiffness[joint] and int(kind) in (_FREE, _BALL):
            drives.leave_out("spring", "joint", joint, scene.joints[joint])
        if _any(model, "dof_dampingpoly", dof):
            drives.leave_out("damping that is not linear", "joint", joint, scene.joints[joint])
        if kind == _BALL and (model.jnt_limited[joint] or model.dof_armature[dof] or model.dof_frictionloss[dof]):
            drives.leave_out("range, armature or friction of a ball", "joint", joint, scene.joints[joint])
        if kind == _FREE and any(values[dof : dof + 6].any() for values in _losses(model)):
            drives.leave_out("losses of a free joint", "joint", joint, scene.joints[joint])
    for motor in (motor for motors in drives.motors.values() for motor in motors):
        if any(_any(model, f"actuator_{name}", motor.actuator) for name in ("armature", "damping", "dampingpoly")):
            drives.leave_out("armature or damping of actuator", "actuator", motor.actuator)
    for body in scene.bodies:
        if model.body_gravcomp[body]:
            drives.leave_out("gravity compensation", "body", body, scene.links[body])
        if model.body_plugin[body] >= 0:
            drives.leave_out("plugin", "body", body, scene.links[body])
    for tendon in range(model.ntendon):
        pulls = [joint for joint, _ in drives.pulls(tendon)]
        acts = model.tendon_limited[tendon] or any(np.any(values[tendon]) for values in _forces(model))
        if acts and (not pulls or any(joint in drives.joints for joint in pulls)):
            drives.leave_out("tendon", "tendon", tendon)
    for pair in range(model.npair):
        geoms = model.pair_geom1[pair], model.pair_geom2[pair]
        if any(int(model.geom_bodyid[geom]) in scene.bodies[not scene.is_floating :] for geom in geoms):
            drives.leave_out("contact pair", "pair", pair)
    for flex in range(model.nflex):
        drives.leave_out("flexible body", "flex", flex)
    for number in range(model.nexclude if scene.is_floating else 0):
        signature = int(model.exclude_signature[number])
        excluded = {signature >> 16, signature & 0xFFFF}
        if 0 in excluded and not excluded.isdisjoint(scene.bodies):
            drives.left_out.append(
                OmittedPart("contact without the ground", "", _option_line(scene, "exclude", "body1"))
            )
    _find_global(scene, drives)


def _find_global(scene: MujocoScene, drives: Drives) -> None:
    """Add what acts on all bodies: switches, another gravity, or a fluid."""
    model = scene.model
    for name in (*_SWITCHES, *["CONTACT"] * scene.is_floating):
        if model.opt.disableflags & getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}", 0):
            drives.left_out.append(
                OmittedPart("disabled flag", name.lower(), _option_line(scene, "flag", name.lower()))
            )
    if not np.allclose(model.opt.gravity, _GRAVITY, rtol=0, atol=0.01):
        words = " ".join(f"{value:g}" for value in model.opt.gravity)
        drives.left_out.append(OmittedPart("gravity", words, _option_line(scene, "option", "gravity")))
    for name in ("density", "viscosity"):
        if getattr(model.opt, name):
            drives.left_out.append(OmittedPart("fluid", name, _option_line(scene, "option", name)))


def _option_line(scene: MujocoScene, tag: str, attribute: str) -> int:
    """Return the last line of the text with an element that has an attribute: later options count; 0 for none."""
    lines = scene.document.text.split("\n")
    has = (line.lstrip().startswith(f"<{tag} ") and f' {attribute}="' in line for line in reversed(lines))
    return next((len(lines) - number for number, is_it in enumerate(has) if is_it), 0)


def _add_soft(robot: UrdfElement, scene: MujocoScene, drives: Drives) -> None:
    """Add an element for each constraint that gives way more or less than usual in MuJoCo: no model's does."""
    model = scene.model
    for joint in drives.joints:
        numbers = *model.jnt_solref[joint], *model.jnt_solimp[joint]
        if model.jnt_limited[joint] and not np.allclose(numbers, (*_SOLREF, *_SOLIMP)):
            robot.add("solreflimit", scene.line("joint", joint), name=scene.joints[joint])
        if model.jnt_limited[joint] and model.jnt_margin[joint]:
            robot.add("margin", scene.line("joint", joint), name=scene.joints[joint])
    for geom in range(model.ngeom if scene.is_floating else 0):
        if int(model.geom_bodyid[geom]) in scene.bodies and model.geom_margin[geom]:
            robot.add("margin", scene.line("geom", geom), name=scene.name("geom", geom) or None)
    for number in range(model.neq):
        if not model.eq_active0[number]:
            robot.add("inactive", scene.line("equality", number), name=scene.name("equality", number) or None)
        elif not np.allclose((*model.eq_solref[number], *model.eq_solimp[number]), (*_SOLREF, *_SOLIMP)):
            robot.add("solref", scene.line("equality", number), name=scene.name("equality", number) or None)


def _any(model: Any, field: str, number: int) -> bool:
    """Return whether a field of newer versions of MuJoCo has a number other than zero."""
    return bool(np.any(getattr(model, field)[number])) if hasattr(model, field) else False


def _losses(model: Any) -> tuple[Any, Any, Any]:
    return model.dof_damping, model.dof_frictionloss, model.dof_armature


def _forces(model: Any) -> Iterator[Any]:
    """Yield the properties by which a tendon acts on its joints, each for all tendons."""
    for name in ("stiffness", "stiffnesspoly", "damping", "dampingpoly", "frictionloss", "armature", "actfrclimited"):
        if hasattr(model, f"tendon_{name}"):
            yield getattr(model, f"tendon_{name}")


def add_leftovers(robot: UrdfElement, scene: MujocoScene, drives: Drives) -> None:
    """Add an element for each part that is left out, and for each element without an effect."""
    for part in drives.left_out:
        robot.add("left_out", part.line, name=part.name, what=part.what)
    for tag, name, place in scene.document.noted:
        robot.add(tag, place, name=name or None)
    model = scene.model
    for top in range(1, model.nbody):
        if model.body_parentid[top] == 0 and top not in scene.bodies:
            robot.add("body", scene.line("body", top), name=scene.links[top])
    for motors in drives.motors.values():
        first = motors[0].actuator
        line, name = scene.line("actuator", first), scene.name("actuator", first)
        if motors[0].servo is None:  # Run moves the joint exactly, and its limits of effort are the same on both sides
            robot.add("feedback", line, name=name or None)
            limits = model.actuator_forcerange[first]
            if model.actuator_forcelimited[first] and limits[0] != -limits[1]:
                robot.add("forcerange", line, name=name or None)
        if int(model.actuator_dyntype[first]) not in _AT_ONCE:
            robot.add("activation", line, name=name or None)
        for motor in motors[1:]:  # the first one commands the joint, and all of them limit its effort
            line, name = scene.line("actuator", motor.actuator), scene.name("actuator", motor.actuator)
            robot.add("motor", line, name=name or None)
    for number in drives.disabled:
        robot.add("inactive", scene.line("actuator", number), name=scene.name("actuator", number) or None)
    _add_soft(robot, scene, drives)
    for key in range(model.nkey):
        if scene.name("key", key) == "home":
            for joint in drives.poses(key):
                robot.add("qpos", scene.line("key", key), name=scene.joints[joint])
        else:
            pose = robot.add("group_state", scene.line("key", key), name=scene.name("key", key) or f"key {key + 1}")
            for joint, position in drives.positions(key).items():
                pose.add("joint", name=scene.joints[joint], value=position)
