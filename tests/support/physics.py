"""Generated robots under prescribed motion, and Pinocchio as the reference: poses of links, efforts of axes.

Every driven axis moves as q = a0 + a1·t + a2·t²/2. Pinocchio's inverse dynamics (`rnea`, Featherstone's
recursive Newton-Euler algorithm) take every joint as independent; joints that mimic others enter through
q = B·p + c with the positions p of the driven axes, so that their efforts are Bᵀ·tau.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from support.modelica import Outcome, Run, Series, Task, execute
from support.packages import Package
from urdfsync.urdf.robot import Joint
from urdfsync.urdf.skeleton import MOTIONS

Array = NDArray[np.float64]

GRAVITY = 9.81
WORLD = f"inner Modelica.Mechanics.MultiBody.World world(n = {{0, 0, -1}}, g = {GRAVITY}, enableAnimation = false);"
DURATION = 0.01  # s
STEEPNESS = 50  # s/rad or s/m: dry friction is f·tanh(50·v)
TOLERANCE = 1e-10

_VECTORS = {"rotational": ("phi", "tau", "Rotational"), "translational": ("s", "f", "Translational")}

_DRIVE = """
  model {Domain}Drive
    parameter Real a0 = 0;
    parameter Real a1 = 0;
    parameter Real a2 = 0;
    Modelica.Mechanics.{Domain}.Interfaces.Flange_b flange;
  equation
    flange.{q} = a0 + a1*time + a2*time^2/2;
  end {Domain}Drive;
"""
DRIVES = "".join(_DRIVE.format(Domain=domain, q=q) for q, _, domain in _VECTORS.values())
"""Modelica models that move a flange as q = a0 + a1·t + a2·t²/2."""


@dataclasses.dataclass(frozen=True)
class Motion:
    """Positions, speeds and accelerations at time 0, one per driven axis, accelerations constant."""

    q: Array
    v: Array
    a: Array

    def at(self, time: float) -> Motion:
        """The motion as it is later."""
        return Motion(self.q + self.v * time + self.a * time**2 / 2, self.v + self.a * time, self.a)


@dataclasses.dataclass(frozen=True)
class Errors:
    """Greatest differences to the reference, each relative to the greatest value if that is above 1."""

    position: float
    rotation: float
    effort: float
    mass: float
    center: float

    def worst(self) -> float:
        """The greatest of all."""
        return max(map(float, dataclasses.astuple(self)))


class Reference:
    """Pinocchio's model of a robot, with its coordinates in those of the generated package."""

    def __init__(self, urdf: str, package: Package) -> None:
        self.package = package
        self.axes = driven_axes(package)
        self.model = pin.buildModelFromXML(urdf)
        self.model.gravity.linear = np.array([0, 0, -GRAVITY])
        self.data = self.model.createData()
        joints = {joint.name: joint for joint in package.skeleton.joints}
        self.joints = [joints[name] for name in self.model.names[1:]]
        self.projection, self.offset = self._mimic(joints)

    def _mimic(self, joints: Mapping[str, Joint]) -> tuple[Array, Array]:
        """B and c of q = B·p + c: one row per joint of Pinocchio, one column per driven axis."""
        numbers = {joint.name: k for k, joint in enumerate(self.axes)}
        projection, offset = np.zeros((len(self.joints), len(self.axes))), np.zeros(len(self.joints))
        for row, joint in enumerate(self.joints):
            factor, leader = 1.0, joint
            while leader.mimic is not None:
                offset[row] += factor * leader.mimic.offset
                factor, leader = factor * leader.mimic.multiplier, joints[leader.mimic.joint]
            if leader.name in numbers:
                projection[row, numbers[leader.name]] = factor
        return projection, offset

    def full(self, motion: Motion) -> tuple[Array, Array, Array]:
        """Pinocchio's configuration, velocity and acceleration."""
        positions = self.projection @ motion.q + self.offset
        configuration = np.zeros(self.model.nq)
        for joint, position in zip(self.model.joints[1:], positions, strict=True):
            turns = joint.nq == 2  # continuous: cosine and sine
            configuration[joint.idx_q : joint.idx_q + joint.nq] = (
                (np.cos(position), np.sin(position)) if turns else position
            )
        return configuration, self.projection @ motion.v, self.projection @ motion.a

    def friction(self, v: Array) -> Array:
        """Loss efforts of all joints at the speeds `v`."""
        damping = np.array([joint.dynamics.damping if joint.dynamics else 0.0 for joint in self.joints])
        friction = np.array([joint.dynamics.friction if joint.dynamics else 0.0 for joint in self.joints])
        return np.asarray(damping * v + friction * np.tanh(STEEPNESS * v))

    def efforts(self, motion: Motion) -> Array:
        """What the drives of the axes have to give."""
        q, v, a = self.full(motion)
        return np.asarray(self.projection.T @ (pin.rnea(self.model, self.data, q, v, a) + self.friction(v)))

    def accelerations(self, motion: Motion) -> Array:
        """Accelerations of the axes without drives, at the positions and speeds of `motion`."""
        q, v, _ = self.full(motion)
        upper = np.triu(pin.crba(self.model, self.data, q))
        inertia = upper + np.triu(upper, 1).T
        load = pin.nonLinearEffects(self.model, self.data, q, v) + self.friction(v)
        b = self.projection
        return np.asarray(np.linalg.solve(b.T @ inertia @ b, -b.T @ load))

    def pose(self, link: str, motion: Motion) -> tuple[Array, Array]:
        """Position of a link's frame in the world, and the matrix whose columns are its axes."""
        pin.framesForwardKinematics(self.model, self.data, self.full(motion)[0])
        place = self.data.oMf[self.model.getFrameId(link, pin.BODY)]
        return np.array(place.translation), np.array(place.rotation)

    def mass_and_center(self, motion: Motion) -> tuple[float, Array]:
        """Mass of the whole robot, the root link included, and its centre; zero without any mass."""
        pin.forwardKinematics(self.model, self.data, self.full(motion)[0])
        bodies = list(zip(self.model.inertias, self.data.oMi, strict=True))
        mass = sum(inertia.mass for inertia, _ in bodies)
        moment = sum((inertia.mass * place.act(inertia.lever) for inertia, place in bodies), np.zeros(3))
        return mass, moment / mass if mass else moment


def driven_axes(package: Package) -> list[Joint]:
    """Joints with a drive, in the order of the flange vectors: first those that turn, then those that slide."""
    return [joint for motion in _VECTORS for joint in package.skeleton.axes(motion)]  # type: ignore[arg-type]


def random_motion(count: int, seed: int = 0) -> Motion:
    """A motion of `count` axes, inside one turn so that nothing is lost to rounding."""
    random = np.random.default_rng(seed)
    return Motion(random.uniform(-0.5, 0.5, count), random.uniform(-0.5, 0.5, count), random.uniform(-1, 1, count))


def inverse_check(package: Package, motion: Motion) -> Task:
    """A model that drives every axis of the robot as `motion` says, and the values to compare."""
    declarations, equations, offset = [], ["    connect(world.frame_b, robot.frame_a);"], 0
    for kind, (_, _, domain) in _VECTORS.items():
        count = len(package.skeleton.axes(kind))  # type: ignore[arg-type]
        if count:
            part = slice(offset, offset := offset + count)
            numbers = ", ".join(f"a{k} = {_vector(x[part])}" for k, x in enumerate((motion.q, motion.v, motion.a)))
            declarations.append(f"    {domain}Drive {kind}Drive[{count}]({numbers});")
            equations.append(f"    connect({kind}Drive.flange, robot.{kind}Axis);")
    declarations += ["    Real mass = robot.m;", f"    Real moment[3] = {_moment(package)};"]
    return _check(package, "fixedStart = false", declarations, equations, [*_poses(package), *_efforts(package)])


def forward_check(package: Package, motion: Motion) -> Task:
    """A model in which the robot moves freely from the positions and speeds of `motion`."""
    starts, offset, values = ["fixedStart = true"], 0, []
    for kind, (q, _, _) in _VECTORS.items():
        axes = package.skeleton.axes(kind)  # type: ignore[arg-type]
        part = slice(offset, offset := offset + len(axes))
        if axes:
            v = {"phi": "w", "s": "v"}[q]
            starts += [f"{q}_start = {_vector(motion.q[part])}", f"{v}_start = {_vector(motion.v[part])}"]
        values += [f"{_axis(package, joint)}.a" for joint in axes]
    return _check(package, ", ".join(starts), [], ["    connect(world.frame_b, robot.frame_a);"], values)


def measure(library: Path, packages: Path, reference: Reference, motion: Motion) -> tuple[Errors, Outcome]:
    """Simulate the inverse check of a written package and compare it with the reference."""
    task = inverse_check(reference.package, motion)
    (outcome,) = execute(library, [packages], [task])
    assert not outcome.error, outcome.error
    (series,) = outcome.runs
    assert not series.error, series.error
    return compare(reference, motion, series), outcome


def compare(reference: Reference, motion: Motion, series: Series) -> Errors:
    """Differences at the first and at the last instant."""
    positions, rotations, efforts, masses, centers = [], [], [], [], []
    assert np.isclose(series.times[-1], DURATION)
    for instant in (0, -1):
        now = motion.at(float(series.times[instant]))
        for link in reference.package.skeleton.links:
            place, axes = _simulated_pose(reference.package, link.name, series, instant)
            expected_place, expected_axes = reference.pose(link.name, now)
            positions.append((place, expected_place))
            rotations.append((axes, expected_axes))
        given = np.array([series.values[name][instant] for name in _efforts(reference.package)])
        efforts.append((given, reference.efforts(now)))
        mass, center = _simulated_mass(series, instant)
        expected_mass, expected_center = reference.mass_and_center(now)
        masses.append((np.array([mass]), np.array([expected_mass])))
        centers.append((center, expected_center))
    return Errors(*map(_relative, (positions, rotations, efforts, masses, centers)))


def _relative(pairs: Sequence[tuple[Array, Array]]) -> float:
    got, expected = (np.concatenate([pair[k].ravel() for pair in pairs]) for k in (0, 1))
    assert np.isfinite(got).all()
    if not expected.size:
        return 0.0
    return float(np.abs(got - expected).max() / max(1.0, np.abs(expected).max()))


def _check(
    package: Package, modifiers: str, declarations: list[str], equations: list[str], values: Sequence[str]
) -> Task:
    source = "\n".join(
        [
            "package Check_",
            "  import Modelica;",
            "  import UrdfSync;",
            DRIVES,
            "  model Check",
            f"    {WORLD}",
            f"    {package.target.package}.{package.target.name} robot({modifiers});",
            *declarations,
            "  equation",
            *equations,
            "  end Check;",
            "end Check_;",
        ]
    )
    return Task(source, "Check_.Check", [Run(DURATION, DURATION / 4)], list(values))


def _poses(package: Package) -> Iterator[str]:
    for link in package.skeleton.links:
        component = f"robot.{package.skeleton.link(link.name).component}"
        yield from (f"{component}.frame_a.r_0[{i}]" for i in (1, 2, 3))
        yield from (f"{component}.frame_a.R.T[{i},{j}]" for i in (1, 2, 3) for j in (1, 2, 3))
    yield from ("mass", *(f"moment[{i}]" for i in (1, 2, 3)))


def _efforts(package: Package) -> list[str]:
    return [
        f"robot.{kind}Axis[{k}].{effort}"
        for kind, (_, effort, _) in _VECTORS.items()
        for k, _ in enumerate(package.skeleton.axes(kind), 1)  # type: ignore[arg-type]
    ]


def _simulated_pose(package: Package, link: str, series: Series, instant: int) -> tuple[Array, Array]:
    frame = f"robot.{package.skeleton.link(link).component}.frame_a"
    place = np.array([series.values[f"{frame}.r_0[{i}]"][instant] for i in (1, 2, 3)])
    turned = np.array([[series.values[f"{frame}.R.T[{i},{j}]"][instant] for j in (1, 2, 3)] for i in (1, 2, 3)])
    return place, turned.T  # the rows of T are the axes of the frame


def _simulated_mass(series: Series, instant: int) -> tuple[float, Array]:
    mass = float(series.values["mass"][instant])
    moment = np.array([series.values[f"moment[{i}]"][instant] for i in (1, 2, 3)])
    return mass, moment / mass if mass else moment


def _moment(package: Package) -> str:
    """The sum of mass times place over all bodies, in Modelica."""
    terms = []
    for link in package.skeleton.links:
        name = f"robot.{package.skeleton.link(link.name).component}"
        center = f"Modelica.Mechanics.MultiBody.Frames.resolve1({name}.frame_a.R, {name}.body.r_CM)"
        terms.append(f"{name}.body.m*({name}.frame_a.r_0 + {center})")
    return " + ".join(terms)


def _axis(package: Package, joint: Joint) -> str:
    return f"robot.{package.skeleton.joint(joint.name).component}.{_INNER[MOTIONS[joint.type]]}"


_INNER = {"rotational": "revolute", "translational": "prismatic"}


def _vector(values: Array) -> str:
    return "{" + ", ".join(repr(float(value)) for value in values) + "}"
