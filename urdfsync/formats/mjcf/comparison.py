"""Compares the URDF of a robot with its MJCF: MuJoCo reads both, and says how they move at random states.

MuJoCo's own reader of URDF shares no code with the translation. It knows neither armature nor springs, so these numbers
are added to its model; it merges links, and reads shapes from files, unless it is told otherwise. Constraints and
tendons are in none of the compared forces: the couplings and loops of the URDF are not compared. Of motors, the
greatest effort is compared, and the effort of each law: MuJoCo computes it with the actuator of the MJCF, and this
module by the documented law from the numbers in the URDF.
"""

from __future__ import annotations

import copy
from collections.abc import Collection, Iterator, Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco
import numpy as np

from urdfsync.formats.mjcf.document import MjcfDocument
from urdfsync.formats.mjcf.drives import Drives
from urdfsync.formats.mjcf.geoms import compare_shapes, complete
from urdfsync.formats.mjcf.scene import WORLD, MujocoScene, read_scene
from urdfsync.formats.urdf.parse.xml import parse

_STATES = 5
_TOLERANCE = 1e-9
"""The greatest difference that counts as agreement, relative to the greatest number of the kind."""
_LEAST = "1e-14"
"""In kg and kg·m²: MuJoCo refuses links without mass that move."""
_FAR = 1e9
"""A position in rad or m, a velocity, and a command: each saturates an actuator with limits."""
_FREE = " free"
"""The joint that moves a floating robot; no name in an MJCF begins so by chance."""
_OF_COMMANDS = "actuator_ctrllimited", "actuator_actlimited"
_LIMITS = (*_OF_COMMANDS, "actuator_forcelimited", "jnt_actfrclimited")
"""Fields that say whether a limit counts."""


class _Numbers(NamedTuple):
    """The same numbers of both models."""

    quantity: str
    element: str
    source: Any
    urdf: Any
    least: float = 1e-9
    """The least size to which a difference is relative."""


def compare(document: MjcfDocument, text: str, body: str = "") -> tuple[int, tuple[str, ...]]:
    """Return how many numbers were compared, and a line for each quantity that differs. Raises TranslationError."""
    scene = read_scene(document, body, with_meshes=True)
    root = parse(text.encode()).root
    if hasattr(scene.model, "actuator_delay"):  # newer versions have it
        scene.model.actuator_delay[:] = 0.0
    pushes = _Pushes(scene)
    efforts = [*_efforts(pushes, root), *_laws(pushes, root)]
    _leave_out(scene)
    model = _read_urdf(root, document, scene.links[scene.root] if scene.is_floating else "")
    joints = {
        (
            _FREE if scene.is_floating and int(scene.model.jnt_bodyid[number]) == scene.root else scene.joints[number]
        ): number
        for number in pushes.drives.joints
    }
    states = np.random.default_rng(0)
    (total, shapes), worst = compare_shapes(scene, root, model), dict[str, tuple[float, str]]()
    motion = (each for _ in range(_STATES) for each in _motion(scene, model, joints, states))
    for numbers in (*efforts, *_constants(scene, model, joints, root), *motion):
        total += numbers.source.size
        size = max(numbers.least, float(np.abs(numbers.source).max(initial=0)))
        error = float(np.abs(numbers.source - numbers.urdf).max(initial=0)) / size
        if not error <= _TOLERANCE:  # not a number is an error, too
            worst[numbers.quantity] = max(worst.get(numbers.quantity, (0.0, "")), (error, numbers.element))
    differences = (f"{quantity} of {element} differs by {error:.1e}" for quantity, (error, element) in worst.items())
    return total, (*differences, *shapes)


def _leave_out(scene: MujocoScene) -> None:
    """Remove from MuJoCo's mass matrix what no URDF has: the translation has told it."""
    model = scene.model
    for joint in map(model.joint, range(model.njnt)):
        if len(joint.damping) > 1:  # a free joint or a ball
            joint.armature[:] = joint.frictionloss[:] = joint.stiffness[:] = 0.0
    for name in (
        "actuator_armature",
        "tendon_armature",
        "jnt_stiffnesspoly",
        "tendon_stiffness",
        "tendon_stiffnesspoly",
    ):
        if hasattr(model, name):  # newer versions have it
            getattr(model, name)[:] = 0.0
    # a random state may have more contacts than MuJoCo has memory for
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    mujoco.mj_setConst(model, mujoco.MjData(model))


def _read_urdf(root: Element, document: MjcfDocument, floating: str) -> Any:
    """Return MuJoCo's model of a URDF with its shapes; a joint moves its link `floating`, if there is one."""
    robot = copy.deepcopy(root)
    for part in [part for part in robot if part.tag not in ("link", "joint")]:
        robot.remove(part)
    for link in robot.findall("link"):
        for shape in [part for part in link if part.tag in ("visual", "collision")]:
            link.remove(shape)
    for joint in robot.findall("joint"):
        if joint.get("type") == "ball":
            joint.set("type", "spherical")
    if floating:
        SubElement(robot, "link", name=WORLD)
        joint = SubElement(robot, "joint", name=_FREE, type="floating")
        SubElement(joint, "parent", link=WORLD)
        SubElement(joint, "child", link=floating)
    settings = {
        "inertiafromgeom": "false",
        "discardvisual": "false",
        "fusestatic": "false",
        "balanceinertia": "false",
        "boundmass": _LEAST,
        "boundinertia": _LEAST,
    }
    SubElement(SubElement(robot, "mujoco"), "compiler", settings)
    spec = mujoco.MjSpec.from_string(tostring(robot, "unicode"))
    complete(spec, root, document)
    return spec.compile()


def _constants(scene: MujocoScene, urdf: Any, joints: Mapping[str, int], root: Element) -> Iterator[_Numbers]:
    """Yield masses, losses and ranges; add armatures and springs of the URDF to its model."""
    for body, link in _links(scene):
        mass = max(float(scene.model.body_mass[body]), float(_LEAST))
        yield _Numbers("mass", f"link {link}", np.array([mass]), urdf.body(link).mass)
    written = {joint.get("name", ""): joint.find("dynamics") for joint in root.findall("joint")}
    for name, number in joints.items():
        if name == _FREE:
            continue
        numbers = {} if (dynamics := written.get(name)) is None else dynamics.attrib
        first, second = scene.model.joint(number), urdf.joint(name)
        second.armature[:] = float(numbers.get("armature", "0"))
        if len(second.armature) == 1:
            second.stiffness[:] = float(numbers.get("spring_stiffness", "0"))
            second.qpos_spring[:] = float(numbers.get("spring_reference", "0"))
            if first.limited[0]:
                yield _Numbers("range", f"joint {name}", first.range - first.qpos0, second.range)
        yield _Numbers("damping", f"joint {name}", first.damping, second.damping)
        yield _Numbers("friction", f"joint {name}", first.frictionloss, second.frictionloss)
    mujoco.mj_setConst(urdf, mujoco.MjData(urdf))  # the mass matrix of a body that only slides is a constant


def _links(scene: MujocoScene) -> Iterator[tuple[int, str]]:
    """Yield the bodies that may move with the names of their links."""
    return (
        (body, scene.links[body]) for body in scene.bodies if body and (body != scene.bodies[0] or scene.is_floating)
    )


class _Pushes:
    """Computes the efforts of single actuators, by MuJoCo, without contacts and gravity compensation."""

    def __init__(self, scene: MujocoScene) -> None:
        self.scene, self.drives = scene, Drives(scene)
        self._model = copy.copy(scene.model)  # this takes 0.1 s with meshes: do it once
        self._model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
        # without this, contacts would take most of the time, and perhaps more memory than MuJoCo has
        self._model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        self._model.body_gravcomp[:] = 0.0  # the translation leaves it out
        self._data = mujoco.MjData(self._model)

    def effort(
        self, leader: int, number: int, position: float, speed: float, ctrl: float, limits: Collection[str] = ()
    ) -> tuple[float, float]:
        """Return the effort of an actuator at the leader of the joints that it moves, and the speed of its activation.

        It has had the command for long, so its activation has settled; the integral of a command is `ctrl`.
        """
        source, model, data, drives = self.scene.model, self._model, self._data, self.drives
        for name in ("actuator_gainprm", "actuator_biasprm"):  # no other actuator acts
            getattr(model, name)[:] = 0.0
            getattr(model, name)[number] = getattr(source, name)[number]
        for name in _LIMITS:
            getattr(model, name)[:] = getattr(source, name) if name in limits else 0
        moved = [(joint, *drives.leader(joint)[1:]) for joint in drives.joints if drives.leader(joint)[0] == leader]
        for joint, factor, offset in moved:
            data.joint(joint).qpos[:] = factor * position + offset
            data.joint(joint).qvel[:] = factor * speed
        data.ctrl[:] = activation = ctrl
        address, control = int(model.actuator_actadr[number]), self.scene.controls[number]
        if model.actuator_ctrllimited[control] and not self.integrates(number):
            activation = np.clip(activation, *model.actuator_ctrlrange[control])
        if model.actuator_actlimited[number]:
            activation = np.clip(activation, *model.actuator_actrange[number])
        data.act[:] = activation
        for step in (mujoco.mj_fwdPosition, mujoco.mj_fwdVelocity, mujoco.mj_fwdActuation):
            step(model, data)
        effort = sum(factor * float(data.joint(joint).qfrc_actuator[0]) for joint, factor, _ in moved)
        return effort, float(data.act_dot[address]) if self.integrates(number) else 0.0

    def integrates(self, number: int) -> bool:
        """Return whether an actuator integrates its command."""
        return bool(self._model.actuator_dyntype[number] == mujoco.mjtDyn.mjDYN_INTEGRATOR)


def _efforts(pushes: _Pushes, root: Element) -> Iterator[_Numbers]:
    """Yield the greatest effort of the motors of each joint that has a limit of effort.

    Position, velocity and command of each motor are far on the side where it pushes.
    """
    scene = pushes.scene
    limits = {joint.get("name", ""): joint.find("limit[@effort]") for joint in root.findall("joint")}
    for leader, motors in pushes.drives.motors.items():
        if (limit := limits.get(scene.joints[leader])) is None:
            continue
        total = 0.0
        for motor in motors:
            far = [(-side, -side, side * float(np.sign(motor.gear))) for side in (_FAR, -_FAR)]
            total += max(abs(pushes.effort(leader, motor.actuator, *state, _LIMITS)[0]) for state in far)
        if scene.model.jnt_actfrclimited[leader]:
            total = min(total, float(np.abs(scene.model.jnt_actfrcrange[leader]).max()))
        written = np.array([float(limit.get("effort", "nan"))])
        yield _Numbers("greatest effort", f"joint {scene.joints[leader]}", np.array([total]), written)


def _laws(pushes: _Pushes, root: Element) -> Iterator[_Numbers]:
    """Yield the effort of each drive whose law is in the URDF, at random positions, speeds and commands.

    Far commands show the limits of the command, without those of the effort, and then the limits of the effort. For an
    integrated command, the speed of its integral is compared, too.
    """
    random = np.random.default_rng(0)
    interfaces = {
        joint.get("name", ""): part
        for joint in root.findall("ros2_control/joint")
        for part in joint.findall("command_interface")
    }
    for leader, motors in pushes.drives.motors.items():
        if motors[0].servo is None:
            continue
        name, number = pushes.scene.joints[leader], motors[0].actuator
        command = interfaces[name].get("name", "")
        law = {param.get("name", ""): float(param.text or "") for param in interfaces[name].findall("param")}
        rest, *moved = (
            pushes.effort(leader, number, *state)[0] for state in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
        )
        # the effort against position or else speed, or 1 without feedback; then the reference for a unit of ctrl
        gain = rest - moved[0] or rest - moved[1] or 1.0
        scale = (moved[2] - rest) / gain
        # a commanded effort has no other limits than those of the effort
        for far, limits in ((1.0, _LIMITS), (_FAR, _LIMITS), *(((_FAR, _OF_COMMANDS),) if command != "effort" else ())):
            expected, written = list[float](), list[float]()
            for side in (1.0, -1.0) * _STATES:
                position, speed, share = random.uniform(-1, 1, 3)
                ctrl = side * far * abs(share)
                effort, rate = pushes.effort(leader, number, position, speed, ctrl, limits)
                expected += [effort, rate * scale]
                # where the actuator gives no effort; without feedback, the reference is the effort
                reference = pushes.effort(leader, number, 0.0, 0.0, ctrl)[0] / gain
                asked = _asked(law, command, reference, position, speed)
                rate = ctrl * scale if pushes.integrates(number) else 0.0
                written += [
                    _limited(asked, law, "effort") if limits is _LIMITS else asked,
                    _limited(rate, law, "velocity"),
                ]
            yield _Numbers("effort of the law", f"joint {name}", np.array(expected), np.array(written))


def _asked(law: Mapping[str, float], command: str, reference: float, position: float, speed: float) -> float:
    """Return the effort that a law asks for, before its limits, as docs/urdf.md has it."""
    stiffness, damping = law.get("position_gain", 0.0), law.get("velocity_gain", 0.0)
    if command == "effort":
        return reference
    if command == "velocity" and not stiffness:
        return damping * (_limited(reference, law, "velocity") - speed)
    return stiffness * (_limited(reference, law, "position") - position) - damping * speed


def _limited(value: float, law: Mapping[str, float], quantity: str) -> float:
    return max(law.get(f"min_{quantity}", -np.inf), min(law.get(f"max_{quantity}", np.inf), value))


def _motion(
    scene: MujocoScene, urdf: Any, joints: Mapping[str, int], random: np.random.Generator
) -> Iterator[_Numbers]:
    """Yield the numbers of both models at a random state."""
    model = scene.model
    source, other = mujoco.MjData(model), mujoco.MjData(urdf)
    urdf.opt.gravity[:], urdf.opt.disableflags = model.opt.gravity, model.opt.disableflags
    pairs = [(name, source.joint(number), other.joint(name)) for name, number in joints.items()]
    for _, first, second in pairs:
        first.qvel[:] = second.qvel[:] = random.uniform(-1, 1, len(first.qvel))
        second.qpos[:] = random.uniform(-1, 1, len(first.qpos))
        if len(first.qpos) > 1:  # the last four are a quaternion
            second.qpos[-4:] /= np.linalg.norm(second.qpos[-4:])
            first.qpos[:] = second.qpos
        else:
            first.qpos[:] = model.joint(first.id).qpos0 + second.qpos
    mujoco.mj_forward(model, source)
    mujoco.mj_forward(urdf, other)
    for body, name in _links(scene):
        yield _Numbers("orientation", f"link {name}", source.xmat[body], other.body(name).xmat)
        if model.body_mass[body]:
            yield _Numbers("centre of mass", f"link {name}", source.xipos[body], other.body(name).xipos)
    for name, first, second in pairs:
        if len(first.qpos) == 1:
            yield _Numbers("axis", f"joint {name}", first.xaxis, second.xaxis)
    weight = float(np.linalg.norm(model.opt.gravity) * sum(model.body_mass[body] for body in scene.bodies))
    rows, columns = (
        [dof for joint in ids for dof in np.flatnonzero(each.dof_jntid == joint)]
        for each, ids in ((model, joints.values()), (urdf, [urdf.joint(name).id for name in joints]))
    )
    yield _Numbers("bias", "the robot", source.qfrc_bias[rows], other.qfrc_bias[columns], max(weight, 1e-9))
    yield _Numbers("spring force", "the robot", source.qfrc_spring[rows], other.qfrc_spring[columns])
    yield _Numbers("mass matrix", "the robot", _mass(model, source, rows), _mass(urdf, other, columns))


def _mass(model: Any, data: Any, dofs: Any) -> Any:
    """Return the mass matrix: its columns are the efforts for unit accelerations."""
    result, columns = np.zeros((model.nv, model.nv)), np.eye(model.nv)
    for column in range(model.nv):
        mujoco.mj_mulM(model, data, result[column], columns[column])
    return result[np.ix_(dofs, dofs)]
