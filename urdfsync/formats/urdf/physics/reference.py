"""Computes a robot's poses, efforts, accelerations and sensor readings by Pinocchio.

Pinocchio reads the file itself. Its reader leaves out `mimic` elements and drives: this module adds them. The first
reader is under test, so this module does not use it. Sensors come from the second reading.

Notation as in Featherstone, Rigid Body Dynamics Algorithms (2008): efforts by the recursive Newton-Euler algorithm
(RNEA, section 5.3). Mimic joints enter through q = B·p + c, where p are the positions of the axes; the efforts of the
axes are Bᵀ·tau. With loops, q̇ = N(p)·ṗ and q̈ = N·p̈ + drift (see `closing`), and efforts are Nᵀ·tau.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple
from xml.etree.ElementTree import tostring

import msgspec
import numpy as np
from numpy.typing import NDArray

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.common.extras import install_command
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops
from urdfsync.formats.urdf.kinematics.poses import start_positions
from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.closing import CLOSED, Closing, Reaction
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.robot import Mimic, Vector
from urdfsync.formats.urdf.second.companions import CatalogueNumbers
from urdfsync.formats.urdf.second.dynamics import OF_DYNAMICS, mechanism_efforts
from urdfsync.formats.urdf.second.gears import Gear, read_gears
from urdfsync.formats.urdf.second.reading import SecondElement, origin

Array = NDArray[np.float64]

TURNING_STEEPNESS, SLIDING_STEEPNESS = 100, 1000
"""Steepness s of the dry friction f·tanh(s·v/2) of generated joints, in s/rad and s/m."""

_GREATEST_CONDITION = 1e12
"""Up to this condition number of the mass matrix, efforts determine accelerations. Real robots have 1 to 1e8."""
_SLIDING_JOINTS = ("JointModelPX", "JointModelPY", "JointModelPZ", "JointModelPrismatic")  # Pinocchio's names


class PinocchioRobot(NamedTuple):
    """Pinocchio's reading of a robot, with the mimic relations and rotors that Pinocchio leaves out."""

    model: Any
    """Pinocchio's model; its first joint is the free motion of the root link."""
    followers: Mapping[str, Mimic]
    """Mimic relations by names of followers."""
    rotors: Array
    """The part of the rotors in the mass matrix: Pinocchio's `armature` can't couple two joints."""
    dynamics: Mapping[str, Array]
    """The attributes `OF_DYNAMICS` at each coordinate of the velocity; `armature` is Pinocchio's own array."""


def read(
    content: bytes, file: str, loose: Collection[str] = (), rows: Mapping[str, CatalogueNumbers] | None = None
) -> PinocchioRobot:
    """Read a URDF with Pinocchio, as `completion` writes it; its gears have the numbers of `rows` of the catalogue.

    Raises SourceError if Pinocchio is not installed or refuses the file.

    Pinocchio merges fixed joints and gives no forces in them, so fixed joints in `loose` become movable. Pinocchio's
    reader lacks ball joints: this function adds them.
    """
    pin = pinocchio()
    root, balls = xml.parse(content).root, set[str]()
    for joint in root.findall("joint"):
        if joint.get("name") in loose and joint.get("type") == "fixed":
            joint.set("type", "continuous")
        elif joint.get("type") in ("ball", "spherical"):
            balls.add(joint.get("name", ""))
            joint.set("type", "continuous")
            for part in [part for part in joint if part.tag in ("axis", "limit")]:
                joint.remove(part)
            for losses in joint.findall("dynamics"):
                losses.set("friction", "0")
    if loose or balls:
        content = tostring(root)
    followers = {
        joint.get("name", ""): Mimic(
            mimic.get("joint", ""), float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        )
        for joint in root.findall("joint")
        for mimic in joint.findall("mimic")
    }
    # an unused name for Pinocchio's root joint
    unused = "_" * (1 + max(len(element.get("name", "")) for element in root.iter()))
    try:
        model = pin.buildModelFromXML(content.decode("utf-8-sig"), pin.JointModelFreeFlyer(), unused)
    except (ValueError, RuntimeError) as error:
        message = f"Pinocchio can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or check without --physics"
        raise SourceError(Diagnostic(Severity.ERROR, "pinocchio-refuses", message, file, hint=hint)) from error
    model = _with_balls(pin, model, balls) if balls else model
    gears, rotors = read_gears(root, rows or {}), np.zeros((model.nv, model.nv))
    numbers = {attribute: np.zeros(model.nv) for attribute in OF_DYNAMICS.values()} | {"armature": model.armature}
    for joint in root.findall("joint"):
        name = joint.get("name", "")
        if model.existJointName(name) and (coordinates := model.joints[model.getJointId(name)]).nv == 1:
            gear, stated = gears.get(name, Gear()), joint.find("dynamics")
            for attribute, values in numbers.items():
                values[coordinates.idx_v] = 0.0 if stated is None else float(stated.get(attribute, "0"))
            ways = np.zeros(model.nv)
            ways[coordinates.idx_v] = gear.reduction
            if gear.joint:
                ways[model.joints[model.getJointId(gear.joint)].idx_v] = gear.joint_reduction
            rotors += (gear.rotor or 0.0) * np.outer(ways, ways)
    return PinocchioRobot(model, followers, rotors, numbers)


def _with_balls(pin: Any, model: Any, balls: Collection[str]) -> Any:
    """Return a model with ball joints instead of the hinges `balls`, with the same damping about each axis."""
    changed = pin.Model()
    for k in range(1, model.njoints):
        name, old = model.names[k], model.joints[k]
        new = pin.JointModelSpherical() if name in balls else old
        changed.addJoint(model.parents[k], new, model.jointPlacements[k], name)
        changed.appendBodyToJoint(k, model.inertias[k], pin.SE3.Identity())
        start = changed.joints[k].idx_v
        for numbers in ("damping", "friction"):
            getattr(changed, numbers)[start : start + new.nv] = getattr(model, numbers)[old.idx_v : old.idx_v + old.nv]
    for frame in model.frames[1:]:
        parts = frame.name, frame.parentJoint, frame.parentFrame, frame.placement, frame.type, frame.inertia
        changed.addFrame(pin.Frame(*parts), append_inertia=False)
    return changed


def pinocchio() -> Any:
    """Return the module `pinocchio`. Raises SourceError if Pinocchio is not installed."""
    try:
        import pinocchio  # an optional extra
    except ImportError:
        message = "Pinocchio, the reference for physics, is not installed"
        hint = install_command("physics")
        raise SourceError(Diagnostic(Severity.ERROR, "no-pinocchio", message, hint=hint)) from None
    return pinocchio


class Configuration(msgspec.Struct, frozen=True):
    """Pinocchio's configuration, velocity and acceleration."""

    q: Array
    v: Array
    a: Array
    positions: Array
    """Positions of joints, in the order of `v`. The positions of the base have no meaning."""
    ways: Array
    """Velocities of all coordinates while one axis moves with velocity 1: a column for each axis."""
    drift: Array
    """Accelerations of all coordinates while no axis accelerates."""


class Reference:
    """A robot in Pinocchio."""

    def __init__(self, robot: PinocchioRobot, axes: Sequence[str], closed: ClosedLoops | None = None) -> None:
        self.pin, self.model = pinocchio(), robot.model
        self.model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        self.axes = tuple(axes)
        """The names of the independent joints. Ball joints come last, and turn about `motion.TURN_AXIS`."""
        self.rotors, self.dynamics = robot.rotors, robot.dynamics
        balls = [joint for joint in self.model.joints if joint.shortname() == "JointModelSpherical"]
        self._balls, self._scalars = [joint.idx_v + k for joint in balls for k in range(3)], len(axes) - len(balls)
        self.projection, self._offset = self._mimic(robot, self.axes)
        self.closing: Closing | None = None
        if closed and closed.closures:
            starts = start_positions(closed.tree)
            others = [name for name in closed.joints if name not in (*self.axes, *robot.followers)]
            followers, _ = self._mimic(robot, others)
            start = self.projection @ [starts[name] for name in self.axes] + self._offset
            first = np.array([starts[name] for name in others])
            self.closing = Closing(self.pin, self.model, closed, followers, start, first)
        self.steepness = np.full(self.model.nv, float(TURNING_STEEPNESS))
        """In s/rad or s/m: steepness of dry friction for each coordinate of Pinocchio's velocity, as in the records."""
        for joint in self.model.joints:
            if joint.shortname().startswith(_SLIDING_JOINTS):
                self.steepness[joint.idx_v] = SLIDING_STEEPNESS

    def state(self, courses: Sequence[Course], base: Sequence[Course] = (*motion.PATH, motion.TURN)) -> Configuration:
        """Return the configuration for courses of the axes, and of the base's place and angle. Raises OpenLoopError."""
        pin, model = self.pin, self.model
        p, speeds, gains = np.array(courses).reshape(-1, 3).T
        positions, ways, drift = self.projection @ p + self._offset, self.projection, np.zeros(model.nv)
        if self.closing:
            positions = self.closing.closed(positions)
            ways, drift = self.closing.motion(positions, self.projection, speeds)
        q = pin.integrate(model, pin.neutral(model), positions)
        state = Configuration(q, ways @ speeds, ways @ gains + drift, positions, ways, drift)
        # Pinocchio resolves velocity and acceleration of the root link in the link's frame.
        place, velocity, acceleration = np.array(base[:3]).T
        angle, speed, gain = base[3]
        axis = np.array(motion.TURN_AXIS)
        inward = pin.exp3(angle * axis).T
        state.q[:7] = *place, *pin.Quaternion(inward.T).coeffs()
        state.v[:6] = *inward @ velocity, *speed * axis
        state.a[:6] = *inward @ acceleration - np.cross(speed * axis, inward @ velocity), *gain * axis
        return state

    def free_state(self, courses: Sequence[Course], start: Mapping[str, Vector]) -> Configuration:
        """Return the configuration at time 0. A free base has the `start` values; any other base rests at zero."""
        state, pin = self.state(courses), self.pin
        state.q[:7], state.v[:6], state.a[:6] = (*(0,) * 6, 1), 0, 0
        if start:
            rotation = pin.rpy.rpyToMatrix(*start["rpy_start"])
            state.q[:7] = *start["r_start"], *pin.Quaternion(rotation).coeffs()
            state.v[:3], state.v[3:6] = (rotation.T @ np.array(start[name]) for name in ("v_start", "w_start"))
        return state

    def base_gain(self, state: Configuration, gains: Array) -> Array:
        """Return the acceleration of the root link's frame in the world, without gravity."""
        rotation = self.pin.Quaternion(state.q[3:7]).matrix()
        return np.asarray(rotation @ (gains[:3] + np.cross(state.v[3:6], state.v[:3])))

    def coordinates(self) -> dict[str, int]:
        """Return the velocity coordinate of each moving joint."""
        return {name: joint.idx_v for name, joint in zip(self.model.names, self.model.joints, strict=True)}

    def free_gains(self, state: Configuration, efforts: Array, is_free: bool) -> tuple[Array, float] | None:
        """Return the accelerations of all coordinates; None if the efforts of the axes do not determine these.

        Return also the relative uncertainty: loops are closed only to `closing.CLOSED`, and a large load on a small
        mass amplifies this error. The base rests, unless `is_free`. Ball joints turn in all directions.
        """
        data, nv = self.model.createData(), self.model.nv
        load = self.load(data, state, state.drift)
        loose = [*(range(6) if is_free else ()), *self._balls]
        ways = np.column_stack([np.eye(nv)[:, loose], state.ways[:, : self._scalars]])
        drives = np.concatenate([np.zeros(len(loose)), efforts[: self._scalars]])
        mass = ways.T @ self._mass(state.q) @ ways
        if len(mass) and not (np.isfinite(mass).all() and np.linalg.cond(mass) < _GREATEST_CONDITION):
            return None
        gains = np.asarray(ways @ self._solved(mass, drives - ways.T @ load) + state.drift)
        if not (self.closing and len(mass)):
            return gains, 0.0
        doubt = CLOSED * np.abs(load[6:]).max() * np.linalg.norm(np.linalg.inv(mass), 2)
        return gains, float(doubt / max(1.0, np.abs(gains).max()))

    def _mass(self, q: Array) -> Array:
        return np.asarray(self.pin.crba(self.model, self.model.createData(), q)) + self.rotors

    def load(self, data: Any, state: Configuration, a: Array) -> Array:
        """Return the efforts of all coordinates, with losses and mechanisms, for a state with accelerations `a`."""
        own = self.losses(state.v) + mechanism_efforts(self.dynamics, state.positions)
        return np.asarray(self.pin.rnea(self.model, data, state.q, state.v, a) + self.rotors @ a + own)

    @staticmethod
    def _solved(mass: Array, efforts: Array) -> Array:
        if not len(efforts) or not np.isfinite(mass).all() or not np.isfinite(efforts).all():
            return np.zeros(len(efforts))  # no simulation accepts infinite numbers
        return np.asarray(np.linalg.lstsq(mass, efforts)[0])

    def measured(self, state: Configuration, sensor: SecondElement, above: str) -> Mapping[str, Array]:
        """Return what a sensor shows, by the library's names; `above` is the link above the sensor's joint, if any."""
        match sensor.type:
            case "imu" | "accelerometer" | "gyroscope":
                gain, turn = self.acceleration(state, sensor)
                return {"a": gain, "w": turn}
            case "force_torque":
                force, torque = self.wrench(state, sensor, above)
                return {"f": force, "t": torque}
        return {}

    def acceleration(self, state: Configuration, sensor: SecondElement) -> tuple[Array, Array]:
        """Return a sensor's acceleration minus gravity, and its angular velocity, in the sensor's axes."""
        pin, model = self.pin, self.model
        link = model.frames[model.getFrameId(sensor.parent, pin.BODY)]
        pose = link.placement * pin.SE3(origin(sensor))
        added = pin.Frame(f"sensor {sensor.name}", link.parentJoint, pose, pin.OP_FRAME)
        frame = model.addFrame(added, append_inertia=False)
        data = model.createData()
        pin.forwardKinematics(model, data, state.q, state.v, state.a)
        pin.updateFramePlacements(model, data)
        gravity = data.oMf[frame].rotation.T @ model.gravity.linear
        gain = pin.getFrameClassicalAcceleration(model, data, frame, pin.LOCAL).linear - gravity
        return gain, pin.getFrameVelocity(model, data, frame, pin.LOCAL).angular

    def wrench(self, state: Configuration, sensor: SecondElement, parent: str) -> tuple[Array, Array]:
        """Return force and torque in a sensor's joint, in the sensor's axes; `parent` is the link above the joint."""
        pin, model = self.pin, self.model
        data, joint = model.createData(), model.getJointId(sensor.parent)
        load = self.load(data, state, state.a)
        if self.closing:
            forces = self.closing.forces(state.positions, load)
            pin.rnea(model, data, state.q, state.v, state.a, forces)
        pin.framesForwardKinematics(model, data, state.q)  # `rnea` leaves `oMi` at the identity
        has_parents_axes, has_parents_sign = sensor.axes
        axes = origin(sensor)[:3, :3].T
        if has_parents_axes:
            link = data.oMf[model.getFrameId(parent, pin.BODY)].rotation
            axes = link.T @ data.oMi[joint].rotation
        sign = 1 if has_parents_sign else -1
        return sign * axes @ data.f[joint].linear, sign * axes @ data.f[joint].angular

    def solve(self, state: Configuration) -> Solution:
        """Return poses, and the efforts of base and axes."""
        pin, data = self.pin, self.model.createData()
        load = self.load(data, state, state.a)
        pin.framesForwardKinematics(self.model, data, state.q)
        reactions = self.closing.reactions(state.positions, load) if self.closing else []
        reactions = [one._replace(gap=data.oMi[1].rotation @ one.gap) for one in reactions]
        return Solution(self, data, state.q, load, load[:3], load[3:6], state.ways.T @ load, reactions)

    def losses(self, v: Array) -> Array:
        """Return efforts of damping and dry friction at velocity v."""
        return np.asarray(self.model.damping * v + self.model.friction * np.tanh(self.steepness * v / 2))

    def _mimic(self, robot: PinocchioRobot, axes: Sequence[str]) -> tuple[Array, Array]:
        """Return B and c of q = B·p + c. B has a row per coordinate of Pinocchio's velocity and a column per axis."""
        projection, offset = np.zeros((self.model.nv, len(axes))), np.zeros(self.model.nv)
        names = set(self.model.names)
        for name, joint in zip(self.model.names, self.model.joints, strict=True):
            factor, leader = 1.0, name
            while leader in names and leader in robot.followers:
                follower = robot.followers[leader]
                offset[joint.idx_v] += factor * follower.offset
                factor, leader = factor * follower.multiplier, follower.joint
            if leader in axes:
                is_ball = joint.shortname() == "JointModelSpherical"
                rows = slice(joint.idx_v, joint.idx_v + joint.nv)
                projection[rows, axes.index(leader)] = motion.TURN_AXIS if is_ball else factor
        return projection, offset


class Solution(msgspec.Struct, frozen=True):
    """Poses and efforts of a robot at one instant, by Pinocchio."""

    reference: Reference
    data: Any
    """Pinocchio's data, with the poses of all frames."""
    q: Array
    load: Array
    """Efforts of all coordinates."""
    force: Array
    """Force on the root link, in the link's frame."""
    torque: Array
    efforts: Array
    """Efforts of the axes."""
    reactions: Sequence[Reaction]
    """Gaps and forces of the loops, in the order of the tree. Gaps are resolved in the world."""

    def frame(self, link: str) -> tuple[Array, Array]:
        """Return place and axes (as columns) of a link's frame in the world."""
        pin, model = self.reference.pin, self.reference.model
        place = self.data.oMf[model.getFrameId(link, pin.BODY)]
        return np.array(place.translation), np.array(place.rotation)

    def mass_and_centre(self) -> tuple[float, Array]:
        """Return the mass of the robot, and the centre of mass in the world; zero without a mass."""
        pin, model = self.reference.pin, self.reference.model
        mass = pin.computeTotalMass(model)
        return mass, np.array(pin.centerOfMass(model, self.data, self.q)) if mass else np.zeros(3)
