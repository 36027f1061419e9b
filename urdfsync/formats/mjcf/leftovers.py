"""Finds what acts on a robot in MuJoCo, and what no model has, and what has no effect on the robot at all."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from urdfsync.formats.mjcf.document import FLEXIBLE
from urdfsync.formats.mjcf.drives import HOME, Drives
from urdfsync.formats.mjcf.scene import MujocoScene
from urdfsync.formats.mjcf.sensors import READ
from urdfsync.formats.mjcf.turns import turned
from urdfsync.formats.translation.writer import UrdfElement

_GRAVITY = (0.0, 0.0, -9.81)
_SILENT = {
    "": "childclass classname compiler frame group id parent rgba signature userdata",
    "joint": "actfrclimited actfrcrange actgravcomp align armature axis damping frictionloss limited pos range ref "
    "springdamper springref stiffness type",
    "geom": "alt castshadow conaffinity contype density fitscale fluid_coefs fluid_ellipsoid friction fromto mass "
    "plugin pos quat size type typeinertia",
    "body": "alt explicitinertial fullinertia fuse ialt inertia ipos iquat mass mocap plugin pos quat simple sleep",
    "tendon": "limited margin range solimp_friction solimp_limit solref_friction solref_limit springlength width",
    "equality": "active data objtype type",
    "actuator": "actdim actlimited actrange biasprm biastype cranklength ctrllimited ctrlrange ctrlspec dynprm dyntype "
    "ffrange forcelimited forcerange gainprm gaintype gear inheritrange interp lengthrange nsample plugin trntype type "
    "velrange",
    "sensor": "datatype dim interp intprm needstage noise nsample objtype plugin reftype type",
    "option": "ccd_iterations ccd_tolerance disableactuator disableflags enableflags gravity integrator iterations "
    "jacobian ls_iterations ls_tolerance magnetic noslip_iterations noslip_tolerance o_friction o_margin o_solimp "
    "o_solref sdf_initpoints sdf_iterations sleep_tolerance solver timestep tolerance wind",
    "flag": "autoreset clampctrl diagexact energy eulerdamp filterparent fwdinv invdiscrete ipc island midphase "
    "multiccd nativeccd refsafe sleep speculative warmstart",
}
"""Attributes by kinds of elements, and of all kinds, that are translated, are told elsewhere, or change no motion.

Any other one that differs from MuJoCo's default acts, also one of a newer version. The names are those of a `MjSpec`.
"""
_NOTED = {
    "joint": "margin solimp_friction solimp_limit solref_friction solref_limit",
    "geom": "condim gap margin priority solimp solmix solref",
    "equality": "solimp solref",
    "actuator": "actearly delay",
    "sensor": "cutoff delay interval",
    "option": "cone impratio",
}
"""Attributes that act, but only a note counts them: they say how contacts, constraints, sensors and commands behave."""
_AT_ONCE = (mujoco.mjtDyn.mjDYN_NONE, mujoco.mjtDyn.mjDYN_INTEGRATOR)
"""Dynamics of actuators without a delay: an integrator of a velocity is a command of the velocity."""
_FREE, _BALL = mujoco.mjtJoint.mjJNT_FREE, mujoco.mjtJoint.mjJNT_BALL


def find_left_out(scene: MujocoScene, drives: Drives) -> None:
    """Add to the drives' list what acts on the robot by other means than joints and motors."""
    model = scene.model
    for joint in drives.joints:
        kind, dof, name = model.jnt_type[joint], model.jnt_dofadr[joint], scene.joints[joint]
        if _any(model, "jnt_stiffnesspoly", joint):
            drives.leave_out("spring that is not linear", "joint", joint, name)
        elif model.jnt_stiffness[joint] and int(kind) in (_FREE, _BALL):
            drives.leave_out("spring", "joint", joint, name)
        if _any(model, "dof_dampingpoly", dof):
            drives.leave_out("damping that is not linear", "joint", joint, name)
        if kind == _BALL and (model.jnt_limited[joint] or model.dof_armature[dof] or model.dof_frictionloss[dof]):
            drives.leave_out("range, armature or friction of a ball", "joint", joint, name)
        losses = (model.dof_damping, model.dof_frictionloss, model.dof_armature)
        if kind == _FREE and any(values[dof : dof + 6].any() for values in losses):
            drives.leave_out("losses of a free joint", "joint", joint, name)
    for body in scene.bodies:
        if model.body_plugin[body] >= 0:
            drives.leave_out("plugin", "body", body, scene.links[body])
    for tendon in range(model.ntendon):
        pulls = [joint for joint, _ in drives.pulls(tendon)]
        silent = f"{_SILENT['']} {_SILENT['tendon']}".split()
        acts = model.tendon_limited[tendon] or any(scene.unusual("tendon", tendon, silent))
        if acts and (not pulls or any(joint in drives.joints for joint in pulls)):
            drives.leave_out("tendon", "tendon", tendon)
    for pair in range(model.npair):
        geoms = model.pair_geom1[pair], model.pair_geom2[pair]
        if any(int(model.geom_bodyid[geom]) in scene.bodies[not scene.is_floating :] for geom in geoms):
            drives.leave_out("contact pair", "pair", pair)
    for number in range(model.nexclude if scene.is_floating else 0):
        signature = int(model.exclude_signature[number])
        excluded = {signature >> 16, signature & 0xFFFF}
        if 0 in excluded and not excluded.isdisjoint(scene.bodies):
            line = _option_line(scene, "exclude", "body1")
            drives.left_out.append(UrdfElement("left_out", line, name="", what="contact without the ground"))
    drives.left_out += [part for part in _unusual(scene, drives) if part.tag == "left_out"]
    silent = _SILENT["flag"].split() + ([] if scene.is_floating else ["contact", "override"])
    for word, bits, flags in (
        ("disabled", mujoco.mjtDisableBit, model.opt.disableflags),
        ("enabled", mujoco.mjtEnableBit, model.opt.enableflags),
    ):
        for bit in (bits(1 << place) for place in range(32) if flags & 1 << place):
            if (name := bit.name.partition("_")[2].lower()) not in silent:
                line = _option_line(scene, "flag", name)
                drives.left_out.append(UrdfElement("left_out", line, name=name, what=f"{word} flag"))


def _unusual(scene: MujocoScene, drives: Drives) -> Iterator[UrdfElement]:
    """Yield what tells, or counts, each attribute that acts on the robot beside those that the translation reads."""
    model = scene.model
    for kind, number, name in _acting(scene, drives):
        noted = [] if kind == "option" and not scene.is_floating else _NOTED.get(kind, "").split()
        silent = {*_SILENT[""].split(), *_SILENT[kind].split(), *(_NOTED["option"].split() if not noted else ())}
        for field in scene.unusual(kind, number, silent):
            line = _option_line(scene, kind, field) if kind == "option" else scene.line(kind, number)
            if field in noted:
                yield UrdfElement(field.replace("_", ""), line, name=name or None)
            else:
                yield UrdfElement("left_out", line, name=name, what=f"{field} of {kind}")
        if kind == "equality" and model.eq_type[number] == mujoco.mjtEq.mjEQ_WELD and model.eq_data[number][10] != 1:
            yield UrdfElement("torquescale", scene.line(kind, number), name=name or None)
    for key in (key for key in range(model.nkey) if scene.name("key", key) == HOME):
        starts = {"qvel": model.key_qvel[key], "act": model.key_act[key]}
        yield from (UrdfElement(word, scene.line("key", key), name=HOME) for word in starts if starts[word].any())
    if (model.opt.gravity != _GRAVITY).any():
        line = _option_line(scene, "option", "gravity")
        if np.allclose(model.opt.gravity, _GRAVITY, rtol=0, atol=0.01):
            yield UrdfElement("gravity", line)
        else:
            words = " ".join(f"{value:g}" for value in model.opt.gravity)
            yield UrdfElement("left_out", line, name=words, what="gravity")
    if scene.is_floating and model.body_quat[scene.root][0] != 1:
        yield UrdfElement("quat", scene.line("body", scene.root), name=scene.links[scene.root])
    for geom in scene.ground:
        # a static body's turn is part of no model
        is_plane, normal = (
            model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE,
            turned(model.geom_quat[geom], (0, 0, 1)),
        )
        if not (is_plane and normal[2] > 1 - 1e-9):
            yield UrdfElement("ground", scene.line("geom", geom), name=scene.name("geom", geom) or None)


def _acting(scene: MujocoScene, drives: Drives) -> Iterator[tuple[str, int, str]]:
    """Yield the kind, number and name of each element that acts on the robot."""
    model, bodies = scene.model, {*scene.bodies}
    yield "option", 0, ""
    yield from (("joint", joint, scene.joints[joint]) for joint in drives.joints)
    yield from (("body", body, scene.links[body]) for body in scene.bodies if body)
    geoms = (n for n in range(model.ngeom) if int(model.geom_bodyid[n]) in bodies and scene.touches(n))
    others = {
        "geom": [*scene.ground, *geoms] if scene.is_floating else [],  # other robots do not touch the ground
        "actuator": [motor.actuator for motors in drives.motors.values() for motor in motors],
        "equality": [n for n in range(model.neq) if model.eq_active0[n] and not bodies.isdisjoint(scene.ends(n))],
        "sensor": [n for n in range(model.nsensor) if mujoco.mjtSensor(model.sensor_type[n]) in READ],
    }
    yield from ((kind, number, scene.name(kind, number)) for kind, numbers in others.items() for number in numbers)


def _option_line(scene: MujocoScene, tag: str, attribute: str) -> int:
    """Return the last line of the text with an element that has an attribute: later options count; 0 for none."""
    lines = scene.document.text.split("\n")
    has = (line.lstrip().startswith(f"<{tag} ") and f' {attribute}="' in line for line in reversed(lines))
    return next((len(lines) - number for number, is_it in enumerate(has) if is_it), 0)


def _any(model: Any, field: str, number: int) -> bool:
    """Return whether a field of newer versions of MuJoCo has a number other than zero."""
    return bool(np.any(getattr(model, field)[number])) if hasattr(model, field) else False


def add_leftovers(robot: UrdfElement, scene: MujocoScene, drives: Drives) -> None:
    """Add an element for each part that is left out, and for each element without an effect."""
    robot.children += drives.left_out
    for tag, name, place in scene.document.noted:
        if tag in FLEXIBLE:
            robot.add("left_out", place, name=name, what="flexible body")
        else:
            robot.add(tag, place, name=name or None)
    model = scene.model
    for top in range(1, model.nbody):
        if model.body_parentid[top] == 0 and top not in scene.bodies:
            robot.add("body", scene.line("body", top), name=scene.links[top])
    notes = list[tuple[str, str, int]]()
    for motors in drives.motors.values():
        first = motors[0].actuator
        if motors[0].servo is None:  # Run moves the joint exactly, and its limits of effort are the same on both sides
            notes.append(("feedback", "actuator", first))
            limits = model.actuator_forcerange[first]
            if model.actuator_forcelimited[first] and limits[0] != -limits[1]:
                notes.append(("forcerange", "actuator", first))
        if int(model.actuator_dyntype[first]) not in _AT_ONCE:
            notes.append(("activation", "actuator", first))
        # the first one commands the joint, and all of them limit its effort
        notes += [("motor", "actuator", motor.actuator) for motor in motors[1:]]
    notes += [("inactive", "actuator", number) for number in drives.disabled]
    notes += [("inactive", "equality", number) for number in range(model.neq) if not model.eq_active0[number]]
    for tag, kind, number in notes:
        robot.add(tag, scene.line(kind, number), name=scene.name(kind, number) or None)
    robot.children += [part for part in _unusual(scene, drives) if part.tag != "left_out"]
    for key in range(model.nkey):
        if scene.name("key", key) == HOME:
            for joint in drives.poses(key):
                robot.add("qpos", scene.line("key", key), name=scene.joints[joint])
        else:
            pose = robot.add("group_state", scene.line("key", key), name=scene.name("key", key) or f"key {key + 1}")
            for joint, position in drives.positions(key).items():
                pose.add("joint", name=scene.joints[joint], value=position)
