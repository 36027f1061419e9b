"""Computes a robot's poses, efforts, accelerations and sensor readings by Pinocchio, or by MuJoCo where that is absent.

Both read the file themselves. Their readers leave out `mimic` elements and drives: this module adds them. The first
reader is under test, so this module does not use it. Sensors come from the second reading.

Notation as in Featherstone, Rigid Body Dynamics Algorithms (2008): efforts by the recursive Newton-Euler algorithm
(RNEA, section 5.3). Mimic joints enter through q = B·p + c, where p are the positions of the axes; the efforts of the
axes are Bᵀ·tau. With loops, q̇ = N(p)·ṗ and q̈ = N·p̈ + drift (see `closing`), and efforts are Nᵀ·tau.
"""

from __future__ import annotations

import copy
from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple

import msgspec
import numpy as np
from numpy.typing import ArrayLike
from trimesh import transformations

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.common.extras import install_command
from urdfsync.domain.experiment import MissingReferenceError
from urdfsync.formats.urdf.kinematics.loops import ClosedLoops
from urdfsync.formats.urdf.kinematics.poses import start_positions
from urdfsync.formats.urdf.parse import xml
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.physics.closing import CLOSED, Closing, Reaction
from urdfsync.formats.urdf.physics.motion import Course
from urdfsync.formats.urdf.physics.multibody import Array, Multibody
from urdfsync.formats.urdf.robot import Mimic, Vector
from urdfsync.formats.urdf.second import dynamics
from urdfsync.formats.urdf.second.companions import CatalogueNumbers
from urdfsync.formats.urdf.second.gears import Gear, read_gears
from urdfsync.formats.urdf.second.reading import SecondElement, origin, rotation

TURNING_STEEPNESS, SLIDING_STEEPNESS = 100, 1000
"""Steepness s of the dry friction f·tanh(s·v/2) of generated joints, in s/rad and s/m."""

_GREATEST_CONDITION = 1e12
"""Up to this condition number of the mass matrix, efforts determine accelerations. Real robots have 1 to 1e8."""


class ReadRobot(NamedTuple):
    """A robot in Pinocchio or MuJoCo, with the mimic relations and rotors that both leave out."""

    multibody: Multibody
    followers: Mapping[str, Mimic]
    """Mimic relations by names of followers."""
    rotors: Array
    """The part of the rotors in the mass matrix: an `armature` can't couple two joints."""
    dynamics: Mapping[str, Array]
    """The attributes of `<dynamics>`, and the steepness of dry friction, at each coordinate of the velocity.

    `damping`, `friction` and `armature` are the library's own arrays.
    """


def read(
    content: bytes, file: str, loose: Collection[str] = (), rows: Mapping[str, CatalogueNumbers] | None = None
) -> ReadRobot:
    """Read a URDF, as `completion` writes it, with Pinocchio, else with MuJoCo; `rows` are those of the catalogue.

    Raises MissingReferenceError, and SourceError if the reference refuses the file.

    Pinocchio merges fixed joints and gives no forces in them, so fixed joints in `loose` become movable.
    """
    library = reference_class()
    root, balls = xml.parse(content).root, set[str]()
    for joint in root.findall("joint"):
        if joint.get("name") in loose and joint.get("type") == "fixed":
            joint.set("type", "continuous")
        elif joint.get("type") in ("ball", "spherical"):
            balls.add(joint.get("name", ""))
            for losses in joint.findall("dynamics"):
                losses.set("friction", "0")
    followers = {
        joint.get("name", ""): Mimic(
            mimic.get("joint", ""), float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        )
        for joint in root.findall("joint")
        for mimic in joint.findall("mimic")
    }
    try:
        multibody = library(copy.deepcopy(root), balls)
    except (ValueError, RuntimeError) as error:
        message = f"{library.name} can't read this file: {str(error).rstrip('.')}"
        hint = "correct the file, or check without --physics"
        raise SourceError(Diagnostic(Severity.ERROR, "reference-refuses", message, file, hint=hint)) from error
    gears, rotors = read_gears(root, rows or {}), np.zeros((multibody.nv, multibody.nv))
    attributes = (dynamics.LOSSES | dynamics.OF_AXES).values()
    numbers = {attribute: np.zeros(multibody.nv) for attribute in attributes} | {
        "damping": multibody.damping,
        "friction": multibody.friction,
        "armature": multibody.armature,
        "steepness": np.full(multibody.nv, float(TURNING_STEEPNESS)),
    }
    for joint in root.findall("joint"):
        name, stated = joint.get("name", ""), joint.find("dynamics")
        if (row := multibody.coordinates.get(name)) is None:
            continue
        for attribute in {*dynamics.paths(joint.get("type", "")).values()} - dynamics.DEFAULTS.keys():
            numbers[attribute][row.rows] = 0.0 if stated is None else float(stated.get(attribute, "0"))
        if row.slides:
            numbers["steepness"][row.start] = SLIDING_STEEPNESS
        if row.size == 1:
            gear = gears.get(name, Gear())
            ways = np.zeros(multibody.nv)
            ways[row.start] = gear.reduction
            if gear.joint:
                ways[multibody.coordinates[gear.joint].start] = gear.joint_reduction
            rotors += (gear.rotor or 0.0) * np.outer(ways, ways)
    return ReadRobot(multibody, followers, rotors, numbers)


def reference_class() -> type[Multibody]:
    """Return the reference of this machine. Raises MissingReferenceError if there is none."""
    try:  # Pinocchio has no package for Windows
        from urdfsync.formats.urdf.physics.pinocchio_robot import PinocchioRobot
    except ImportError as without_pinocchio:
        try:
            from urdfsync.formats.urdf.physics.mujoco_robot import MujocoRobot
        except ImportError as error:
            why = f"{without_pinocchio}; {error}"  # not installed, or damaged
            message = f"neither Pinocchio nor MuJoCo can be loaded, the references for physics: {why}"
            raise MissingReferenceError.of("no-reference", message, hint=install_command("physics")) from None
        return MujocoRobot
    return PinocchioRobot


class Configuration(msgspec.Struct, frozen=True):
    """Configuration, velocity and acceleration of all coordinates."""

    q: Array
    """The configuration in the form of the reference."""
    v: Array
    """Its first six are the velocity of the root link, resolved in the link's frame."""
    a: Array
    positions: Array
    """Positions of joints, in the order of `v`. The positions of the base have no meaning."""
    ways: Array
    """Velocities of all coordinates while one axis moves with velocity 1: a column for each axis."""
    drift: Array
    """Accelerations of all coordinates while no axis accelerates."""
    base: Array
    """Axes of the root link, as columns, in the world."""


class Reference:
    """A robot in Pinocchio or MuJoCo."""

    def __init__(self, robot: ReadRobot, axes: Sequence[str], closed: ClosedLoops | None = None) -> None:
        self.multibody = robot.multibody
        self.set_gravity(motion.GRAVITY)
        self.axes = tuple(axes)
        """The names of the independent joints. Ball joints come last, and turn about `motion.TURN_AXIS`."""
        self.rotors, self.dynamics = robot.rotors, robot.dynamics
        rows = self.multibody.coordinates.values()
        self._balls = [row.start + k for row in rows if row.size == 3 for k in range(3)]
        self._scalars = len(axes) - len(self._balls) // 3
        self.projection, self._offset = self._mimic(robot, self.axes)
        self.closing: Closing | None = None
        if closed and closed.closures:
            starts = start_positions(closed.tree)
            others = [name for name in closed.joints if name not in (*self.axes, *robot.followers)]
            followers, _ = self._mimic(robot, others)
            start = self.projection @ [starts[name] for name in self.axes] + self._offset
            first = np.array([starts[name] for name in others])
            self.closing = Closing(self.multibody, closed, followers, start, first)

    def set_gravity(self, gravity: float) -> None:
        """Set the gravity (m/s²) along -z of the world."""
        self.multibody.set_gravity(gravity)
        self.gravity = gravity

    def state(self, courses: Sequence[Course], base: Sequence[Course] = (*motion.PATH, motion.TURN)) -> Configuration:
        """Return the configuration for courses of the axes, and of the base's place and angle. Raises OpenLoopError."""
        place, velocity, acceleration = np.array(base[:3]).T
        angle, speed, gain = base[3]
        axis = np.array(motion.TURN_AXIS)
        axes = transformations.rotation_matrix(angle, axis)[:3, :3]
        # velocity and acceleration of the root link are resolved in the link's frame
        velocity, turning = axes.T @ velocity, speed * axis
        gains = axes.T @ acceleration - np.cross(turning, velocity)
        return self._state(courses, place, axes, (*velocity, *turning), (*gains, *gain * axis))

    def free_state(self, courses: Sequence[Course], start: Mapping[str, Vector]) -> Configuration:
        """Return the configuration at time 0. A free base has the `start` values; any other base rests at zero."""
        rest = (0.0,) * 6
        if not start:
            return self._state(courses, rest[:3], np.eye(3), rest, rest)
        axes = rotation(start["rpy_start"])
        velocity = np.concatenate([axes.T @ start[name] for name in ("v_start", "w_start")])
        return self._state(courses, start["r_start"], axes, velocity, rest)

    def _state(
        self,
        courses: Sequence[Course],
        place: Sequence[float],
        axes: Array,
        velocity: ArrayLike,
        acceleration: ArrayLike,
    ) -> Configuration:
        """Return the configuration for courses of the axes and the motion of the root link's frame."""
        p, speeds, gains = np.array(courses).reshape(-1, 3).T
        positions, ways, drift = self.projection @ p + self._offset, self.projection, np.zeros(self.multibody.nv)
        if self.closing:
            positions = self.closing.closed(positions)
            ways, drift = self.closing.motion(positions, self.projection, speeds)
        v, a = ways @ speeds, ways @ gains + drift
        v[:6], a[:6] = velocity, acceleration
        q = self.multibody.configuration(positions, place, axes)
        return Configuration(q, v, a, positions, ways, drift, axes)

    def base_gain(self, state: Configuration, gains: Array) -> Array:
        """Return the acceleration of the root link's frame in the world, without gravity."""
        return np.asarray(state.base @ (gains[:3] + np.cross(state.v[3:6], state.v[:3])))

    def free_gains(self, state: Configuration, efforts: Array, is_free: bool) -> tuple[Array, float] | None:
        """Return the accelerations of all coordinates; None if the efforts of the axes do not determine these.

        Return also the relative uncertainty: loops are closed only to `closing.CLOSED`, and a large load on a small
        mass amplifies this error. The base rests, unless `is_free`. Ball joints turn in all directions.
        """
        nv = self.multibody.nv
        load = self.load(state, state.drift)
        loose = [*(range(6) if is_free else ()), *self._balls]
        ways = np.column_stack([np.eye(nv)[:, loose], state.ways[:, : self._scalars]])
        drives = np.concatenate([np.zeros(len(loose)), efforts[: self._scalars]])
        mass = ways.T @ self.mass(state) @ ways
        if len(mass) and not (np.isfinite(mass).all() and np.linalg.cond(mass) < _GREATEST_CONDITION):
            return None
        gains = np.asarray(ways @ self._solved(mass, drives - ways.T @ load) + state.drift)
        if not (self.closing and len(mass)):
            return gains, 0.0
        doubt = CLOSED * np.abs(load[6:]).max() * np.linalg.norm(np.linalg.inv(mass), 2)
        return gains, float(doubt / max(1.0, np.abs(gains).max()))

    def load(self, state: Configuration, a: Array) -> Array:
        """Return the efforts of all coordinates, with losses and mechanisms, for a state with accelerations `a`."""
        own = dynamics.loss_efforts(self.dynamics, state.v) + dynamics.mechanism_efforts(self.dynamics, state.positions)
        return np.asarray(self.multibody.efforts(state.q, state.v, a) + self.rotors @ a + own)

    @staticmethod
    def _solved(mass: Array, efforts: Array) -> Array:
        if not len(efforts) or not np.isfinite(mass).all() or not np.isfinite(efforts).all():
            return np.zeros(len(efforts))  # no simulation accepts infinite numbers
        return np.asarray(np.linalg.lstsq(mass, efforts, rcond=None)[0])

    def measured(self, state: Configuration, sensor: SecondElement, ends: Sequence[str] = ()) -> Mapping[str, Array]:
        """Return what a sensor shows, by the library's names; `ends` are the links of the sensor's joint, if any."""
        match sensor.type:
            case "imu" | "accelerometer" | "gyroscope":
                gain, turn = self.acceleration(state, sensor)
                return {"a": gain, "w": turn}
            case "force_torque":
                force, torque = self.wrench(state, sensor, *ends)
                return {"f": force, "t": torque}
        return {}

    def acceleration(self, state: Configuration, sensor: SecondElement) -> tuple[Array, Array]:
        """Return a sensor's acceleration minus gravity, and its angular velocity, in the sensor's axes."""
        data, place = self.multibody.move(state.q, state.v, state.a), origin(sensor)
        axes = self.multibody.pose(data, sensor.parent)[1] @ place[:3, :3]
        at = sensor.parent, tuple(place[:3, 3])
        gain = self.multibody.acceleration(data, *at)[:3] - (0, 0, -self.gravity)
        return axes.T @ gain, axes.T @ self.multibody.jacobian(data, *at)[3:] @ state.v

    def wrench(self, state: Configuration, sensor: SecondElement, parent: str, child: str) -> tuple[Array, Array]:
        """Return force and torque in a sensor's joint between two links, in the sensor's axes."""
        multibody, data = self.multibody, self.multibody.move(state.q)
        force, torque = multibody.wrench(state.q, state.v, state.a, sensor.parent)
        for load in self.closing.loads(state.q, self.load(state, state.a)) if self.closing else ():
            if multibody.jacobian(data, load.link)[:, multibody.coordinates[sensor.parent].start].any():
                # the load acts behind the joint
                force, torque = force - load.force, torque - load.torque_at(multibody.pose(data, child)[0])
        has_parents_axes, has_parents_sign = sensor.axes
        axes = multibody.pose(data, parent if has_parents_axes else child)[1]
        if not has_parents_axes:
            axes = axes @ origin(sensor)[:3, :3]
        sign = 1 if has_parents_sign else -1
        return sign * axes.T @ force, sign * axes.T @ torque

    def mass(self, state: Configuration) -> Array:
        """Return the mass matrix of all coordinates, with rotors."""
        self.multibody.set_gravity(0.0)
        columns = [self.multibody.efforts(state.q, 0 * state.v, unit) for unit in np.eye(self.multibody.nv)]
        self.multibody.set_gravity(self.gravity)
        return np.column_stack(columns) + self.rotors

    def solve(self, state: Configuration) -> Solution:
        """Return poses, and the efforts of base and axes."""
        load = self.load(state, state.a)
        reactions = self.closing.reactions(state.q, load) if self.closing else []
        mass, centre = self.multibody.mass_and_centre(state.q)
        data = self.multibody.move(state.q)
        poses = {link: self.multibody.pose(data, link) for link in self.multibody.links}
        return Solution(poses, mass, centre, load, load[:3], load[3:6], state.ways.T @ load, reactions)

    def _mimic(self, robot: ReadRobot, axes: Sequence[str]) -> tuple[Array, Array]:
        """Return B and c of q = B·p + c. B has a row per coordinate of the velocity and a column per axis."""
        projection, offset = np.zeros((self.multibody.nv, len(axes))), np.zeros(self.multibody.nv)
        for name, row in self.multibody.coordinates.items():
            factor, leader = 1.0, name
            while leader in self.multibody.coordinates and leader in robot.followers:
                follower = robot.followers[leader]
                offset[row.start] += factor * follower.offset
                factor, leader = factor * follower.multiplier, follower.joint
            if leader in axes:
                projection[row.rows, axes.index(leader)] = motion.TURN_AXIS if row.size == 3 else factor
        return projection, offset


class Solution(msgspec.Struct, frozen=True):
    """Poses and efforts of a robot at one instant."""

    poses: Mapping[str, tuple[Array, Array]]
    """Place and axes (as columns) of each link's frame in the world."""
    mass: float
    centre: Array
    """The centre of mass in the world; zero without a mass."""
    load: Array
    """Efforts of all coordinates."""
    force: Array
    """Force on the root link, in the link's frame."""
    torque: Array
    efforts: Array
    """Efforts of the axes."""
    reactions: Sequence[Reaction]
    """Gaps and forces of the loops, in the order of the tree."""
