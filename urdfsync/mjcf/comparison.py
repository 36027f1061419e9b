"""Compares the URDF of a robot with its MJCF: MuJoCo reads both, and says how they move at random states.

MuJoCo's own reader of URDF shares no code with the translation. It knows neither armature nor springs, so these numbers
are added to its model; it merges links, and reads shapes from files, unless it is told otherwise. Constraints and
tendons are in none of the compared forces: the couplings and loops of the URDF are not compared. Of motors, the
greatest effort is compared, and the effort of each law: MuJoCo computes it with the actuator of the MJCF, and this
module by the documented law from the numbers in the URDF.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco
import numpy as np

from urdfsync.mjcf.document import MjcfDocument
from urdfsync.mjcf.drives import Drives, JointActuator
from urdfsync.mjcf.geoms import add_shapes, compare_shapes, set_inertias
from urdfsync.mjcf.scene import WORLD, MujocoScene, read_scene
from urdfsync.urdf.parse.xml import parse

_STATES = 5
_TOLERANCE = 1e-9
"""The greatest difference that counts as agreement, relative to the greatest number of the kind."""
_LEAST = "1e-14"
"""In kg and kg·m²: MuJoCo refuses links without mass that move."""
_FAR = 1e9
"""A position in rad or m, a velocity, and a command: each saturates an actuator with limits."""
_FREE = " free"
"""The joint that moves a floating robot; no name in an MJCF begins so by chance."""
_LENGTHS = {"free": (7, 6), "ball": (4, 3), "slide": (1, 1), "hinge": (1, 1)}
"""Coordinates of position and of velocity, by kinds of joints."""


class _Numbers(NamedTuple):
    """The same numbers of both models."""

    quantity: str
    element: str
    source: Any
    urdf: Any
    least: float = 1e-9
    """The least size to which a difference is relative."""


class _Joint(NamedTuple):
    """A joint in both models: its places in position and velocity."""

    name: str
    source: tuple[slice, slice]
    urdf: tuple[slice, slice]


def compare(document: MjcfDocument, text: str, body: str = "") -> tuple[int, tuple[str, ...]]:
    """Return how many numbers were compared, and a line for each quantity that differs. Raises TranslationError."""
    scene = read_scene(document, body, with_meshes=True)
    root = parse(text.encode()).root
    if hasattr(scene.model, "actuator_delay"):  # newer versions have it
        scene.model.actuator_delay[:] = 0.0
    efforts = [*_efforts(scene, root), *_laws(scene, root)]
    _leave_out(scene)
    model = _read_urdf(root, document, scene.links[scene.root] if scene.is_floating else "")
    joints = list(_joints(scene, model))
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
    for joint in range(model.njnt):
        _, velocity = _places(model, joint)
        if velocity.stop - velocity.start > 1:  # a free joint or a ball
            model.dof_armature[velocity], model.dof_frictionloss[velocity] = 0.0, 0.0
            model.jnt_stiffness[joint] = 0.0
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
    set_inertias(spec, root)
    add_shapes(spec, root, document)
    return spec.compile()


def _joints(scene: MujocoScene, urdf: Any) -> Iterator[_Joint]:
    """Yield the joints of the robot."""
    bodies = {*scene.bodies}
    for number in range(scene.model.njnt):
        if int(scene.model.jnt_bodyid[number]) in bodies:
            is_root = scene.is_floating and int(scene.model.jnt_bodyid[number]) == scene.root
            name = _FREE if is_root else scene.joints[number]
            yield _Joint(name, _places(scene.model, number), _places(urdf, urdf.joint(name).id))


def _places(model: Any, joint: int) -> tuple[slice, slice]:
    kind = mujoco.mjtJoint(model.jnt_type[joint]).name.removeprefix("mjJNT_").lower()
    places = zip((model.jnt_qposadr[joint], model.jnt_dofadr[joint]), _LENGTHS[kind], strict=True)
    position, velocity = (slice(int(first), int(first) + length) for first, length in places)
    return position, velocity


def _constants(scene: MujocoScene, urdf: Any, joints: list[_Joint], root: Element) -> Iterator[_Numbers]:
    """Yield masses, losses and ranges; add armatures and springs of the URDF to its model."""
    model = scene.model
    for body in scene.bodies:
        if body and (body != scene.bodies[0] or scene.is_floating):
            mass = max(float(model.body_mass[body]), float(_LEAST))
            yield _Numbers("mass", f"link {scene.links[body]}", np.array([mass]), urdf.body(scene.links[body]).mass)
    written = {joint.get("name", ""): joint.find("dynamics") for joint in root.findall("joint")}
    for name, (_, at), (_, to) in joints:
        if name == _FREE:
            continue
        numbers = {} if (dynamics := written.get(name)) is None else dynamics.attrib
        urdf.dof_armature[to] = float(numbers.get("armature", "0"))
        if to.stop == to.start + 1:
            same = int(urdf.dof_jntid[to.start])
            urdf.jnt_stiffness[same] = float(numbers.get("spring_stiffness", "0"))
            urdf.qpos_spring[urdf.jnt_qposadr[same]] = float(numbers.get("spring_reference", "0"))
        yield _Numbers("damping", f"joint {name}", model.dof_damping[at], urdf.dof_damping[to])
        yield _Numbers("friction", f"joint {name}", model.dof_frictionloss[at], urdf.dof_frictionloss[to])
        first, second = int(model.dof_jntid[at.start]), int(urdf.dof_jntid[to.start])
        if model.jnt_limited[first] and at.stop == at.start + 1:
            expected = model.jnt_range[first] - model.qpos0[model.jnt_qposadr[first]]
            yield _Numbers("range", f"joint {name}", expected, urdf.jnt_range[second])
    mujoco.mj_setConst(urdf, mujoco.MjData(urdf))  # the mass matrix of a body that only slides is a constant


def _efforts(scene: MujocoScene, root: Element) -> Iterator[_Numbers]:
    """Yield the greatest effort of the motors of each joint that has a limit of effort.

    MuJoCo computes the force of each motor alone: position, velocity and command are far on the side where it pushes.
    """
    drives, model = Drives(scene), copy.copy(scene.model)
    limits = {joint.get("name", ""): joint.find("limit[@effort]") for joint in root.findall("joint")}
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
    gains, biases = model.actuator_gainprm.copy(), model.actuator_biasprm.copy()
    for leader, motors in drives.motors.items():
        moved = _moved_by(drives, leader)
        if (limit := limits.get(scene.joints[leader])) is None:
            continue
        total = 0.0
        for motor in motors:
            model.actuator_gainprm[:], model.actuator_biasprm[:] = 0.0, 0.0
            model.actuator_gainprm[motor.actuator] = gains[motor.actuator]
            model.actuator_biasprm[motor.actuator] = biases[motor.actuator]
            total += max(abs(_effort(model, moved, side, motor)) for side in (1, -1))
        if model.jnt_actfrclimited[leader]:
            total = min(total, float(np.abs(model.jnt_actfrcrange[leader]).max()))
        written = np.array([float(limit.get("effort", "nan"))])
        yield _Numbers("greatest effort", f"joint {scene.joints[leader]}", np.array([total]), written)


def _effort(model: Any, moved: Mapping[int, float], side: int, motor: JointActuator) -> float:
    """Return the effort of the only motor at the first of the `moved` joints, with those that follow it."""
    data = mujoco.MjData(model)
    for joint, factor in moved.items():
        position, velocity = _places(model, joint)
        data.qpos[position], data.qvel[velocity] = -side * factor * _FAR, -side * factor * _FAR
    data.ctrl[:] = ctrl = side * float(np.sign(motor.gear)) * _FAR
    data.act[:] = _settled(model, motor.actuator, ctrl)
    for step in (mujoco.mj_fwdPosition, mujoco.mj_fwdVelocity, mujoco.mj_fwdActuation):
        step(model, data)
    efforts = (factor * data.qfrc_actuator[_places(model, joint)[1]] for joint, factor in moved.items())
    return float(sum(each.item() for each in efforts))


def _laws(scene: MujocoScene, root: Element) -> Iterator[_Numbers]:
    """Yield the effort of each drive whose law is in the URDF, at random positions, speeds and commands.

    Far commands show the limits of the command, without those of the effort, and then the limits of the effort. For an
    integrated command, the speed of its integral is compared, too.
    """
    drives, random, models = Drives(scene), np.random.default_rng(0), _Models.of(scene.model)
    interfaces = {
        joint.get("name", ""): part
        for joint in root.findall("ros2_control/joint")
        for part in joint.findall("command_interface")
    }
    for leader, motors in drives.motors.items():
        if motors[0].servo is None:
            continue
        name = scene.joints[leader]
        interface = interfaces[name]
        command = interface.get("name", "")
        law = {param.get("name", ""): float(param.text or "") for param in interface.findall("param")}
        actuator = _Actuator(models, scene.model, drives, leader, motors[0].actuator)
        # a commanded effort has no other limits than those of the effort
        for far, is_cut in ((1.0, True), (_FAR, True), *(((_FAR, False),) if command != "effort" else ())):
            expected, written = list[float](), list[float]()
            for side in (1.0, -1.0) * _STATES:
                position, speed, share = random.uniform(-1, 1, 3)
                ctrl = side * far * abs(share)
                expected += actuator.push(position, speed, ctrl, is_cut=is_cut)
                reference, rate = actuator.reference(ctrl)
                effort = _asked(law, command, reference, position, speed)
                written += [_limited(effort, law, "effort") if is_cut else effort, _limited(rate, law, "velocity")]
            yield _Numbers("effort of the law", f"joint {name}", np.array(expected), np.array(written))


class _Models(NamedTuple):
    """A model with other limits, and the data for all three. To copy a model with meshes takes 0.1 s: do it once."""

    limited: Any
    uncut: Any
    """Without limits of the effort."""
    unlimited: Any
    data: Any

    @classmethod
    def of(cls, source: Any) -> _Models:
        """Return the models, in which contacts and gravity compensation do not act."""
        limited = copy.copy(source)
        limited.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
        # without this, contacts would take most of the time, and perhaps more memory than MuJoCo has
        limited.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        limited.body_gravcomp[:] = 0.0  # the translation leaves it out
        uncut = copy.copy(limited)
        uncut.actuator_forcelimited[:], uncut.jnt_actfrclimited[:] = 0, 0
        unlimited = copy.copy(uncut)
        unlimited.actuator_ctrllimited[:], unlimited.actuator_actlimited[:] = 0, 0
        return cls(limited, uncut, unlimited, mujoco.MjData(limited))


class _Actuator:
    """One actuator of a model, the only one that acts."""

    def __init__(self, models: _Models, source: Any, drives: Drives, leader: int, number: int) -> None:
        self._models, self._number = models, number
        self._drives, self._moved = drives, _moved_by(drives, leader)
        for model in (models.limited, models.uncut, models.unlimited):
            for name in ("actuator_gainprm", "actuator_biasprm"):
                getattr(model, name)[:] = 0.0
                getattr(model, name)[number] = getattr(source, name)[number]
        self._address = int(source.actuator_actadr[number])
        self._integrates = source.actuator_dyntype[number] == mujoco.mjtDyn.mjDYN_INTEGRATOR
        rest = self._free(0.0, 0.0, 0.0)
        # the effort against position or else speed, or 1 without feedback; then the reference for a unit of ctrl
        self._gain = rest - self._free(1.0, 0.0, 0.0) or rest - self._free(0.0, 1.0, 0.0) or 1.0
        self._scale = (self._free(0.0, 0.0, 1.0) - rest) / self._gain

    def push(self, position: float, speed: float, ctrl: float, *, is_cut: bool) -> tuple[float, float]:
        """Return the effort at the leading joint, and the speed of the integral of the command at the joint's side.

        `is_cut` says whether ranges of the effort count.
        """
        effort = self._effort(self._models.limited if is_cut else self._models.uncut, position, speed, ctrl)
        return effort, float(self._models.data.act_dot[self._address]) * self._scale if self._integrates else 0.0

    def reference(self, ctrl: float) -> tuple[float, float]:
        """Return the reference at the joint's side, and its speed if it is an integral, both without limits.

        At this position or speed the actuator gives no effort; without feedback, the reference is the effort.
        """
        return self._free(0.0, 0.0, ctrl) / self._gain, ctrl * self._scale if self._integrates else 0.0

    def _free(self, position: float, speed: float, ctrl: float) -> float:
        return self._effort(self._models.unlimited, position, speed, ctrl)

    def _effort(self, model: Any, position: float, speed: float, ctrl: float) -> float:
        """Return the effort at a state, with an activation that has settled."""
        data, number = self._models.data, self._number
        for joint, factor in self._moved.items():
            places = _places(model, joint)
            data.qpos[places[0]], data.qvel[places[1]] = factor * position + self._drives.offset(joint), factor * speed
        data.ctrl[:] = ctrl
        data.act[:] = _settled(model, number, ctrl)
        for step in (mujoco.mj_fwdPosition, mujoco.mj_fwdVelocity, mujoco.mj_fwdActuation):
            step(model, data)
        efforts = (factor * data.qfrc_actuator[_places(model, joint)[1]] for joint, factor in self._moved.items())
        return float(sum(each.item() for each in efforts))


def _settled(model: Any, actuator: int, ctrl: float) -> float:
    """Return the activation of an actuator that has had a command for long; the integral of a command is `ctrl`."""
    integrates = model.actuator_dyntype[actuator] == mujoco.mjtDyn.mjDYN_INTEGRATOR
    at = getattr(model, "actuator_ctrladr", range(model.nu))[actuator]
    if model.actuator_ctrllimited[at] and not integrates:
        ctrl = float(np.clip(ctrl, *model.actuator_ctrlrange[at]))
    if model.actuator_actlimited[actuator]:
        ctrl = float(np.clip(ctrl, *model.actuator_actrange[actuator]))
    return ctrl


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


def _moved_by(drives: Drives, leader: int) -> dict[int, float]:
    """Return a joint and those that follow it, with their motion for a unit of the leader's."""
    followers = {joint: factor for joint in drives.followers for top, factor in [drives.leader(joint)] if top == leader}
    return {leader: 1.0} | followers


def _motion(scene: MujocoScene, urdf: Any, joints: list[_Joint], random: np.random.Generator) -> Iterator[_Numbers]:
    """Yield the numbers of both models at a random state."""
    model = scene.model
    source, other = mujoco.MjData(model), mujoco.MjData(urdf)
    urdf.opt.gravity[:], urdf.opt.disableflags = model.opt.gravity, model.opt.disableflags
    for _, (position, velocity), (to, to_velocity) in joints:
        moved = random.uniform(-1, 1, position.stop - position.start)
        source.qvel[velocity] = other.qvel[to_velocity] = random.uniform(-1, 1, velocity.stop - velocity.start)
        if len(moved) > 1:  # the last four are a quaternion
            moved[-4:] /= np.linalg.norm(moved[-4:])
            source.qpos[position] = other.qpos[to] = moved
        else:
            source.qpos[position], other.qpos[to] = model.qpos0[position] + moved, moved
    mujoco.mj_forward(model, source)
    mujoco.mj_forward(urdf, other)
    for body in scene.bodies:
        if body and (body != scene.bodies[0] or scene.is_floating):
            name, same = scene.links[body], urdf.body(scene.links[body]).id
            yield _Numbers("orientation", f"link {name}", source.xmat[body], other.xmat[same])
            if model.body_mass[body]:
                yield _Numbers("centre of mass", f"link {name}", source.xipos[body], other.xipos[same])
    for name, (_, at), (_, to) in joints:
        first, second = int(model.dof_jntid[at.start]), int(urdf.dof_jntid[to.start])
        if name != _FREE and at.stop == at.start + 1:
            yield _Numbers("axis", f"joint {name}", source.xaxis[first], other.xaxis[second])
    rows, columns = _dofs([joint.source[1] for joint in joints]), _dofs([joint.urdf[1] for joint in joints])
    weight = float(np.linalg.norm(model.opt.gravity) * sum(model.body_mass[body] for body in scene.bodies))
    yield _Numbers("bias", "the robot", source.qfrc_bias[rows], other.qfrc_bias[columns], max(weight, 1e-9))
    yield _Numbers("spring force", "the robot", source.qfrc_spring[rows], other.qfrc_spring[columns])
    yield _Numbers("mass matrix", "the robot", _mass(model, source, rows), _mass(urdf, other, columns))


def _dofs(places: list[slice]) -> Any:
    return np.concatenate([np.arange(place.start, place.stop) for place in places])


def _mass(model: Any, data: Any, dofs: Any) -> Any:
    """Return the mass matrix: its columns are the efforts for unit accelerations."""
    result, columns = np.zeros((model.nv, model.nv)), np.eye(model.nv)
    for column in range(model.nv):
        mujoco.mj_mulM(model, data, result[column], columns[column])
    return result[np.ix_(dofs, dofs)]
