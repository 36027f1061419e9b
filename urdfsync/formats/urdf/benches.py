"""Describes how a generated robot is compiled, compared and simulated.

`urdfsync.domain.experiment.Checks` and `urdfsync.domain.bench.Benches` describe the functions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from urdfsync.domain import Target
from urdfsync.domain.bench import Bench, JointSignals, LoopSignals, Signal
from urdfsync.domain.experiment import Experiment, Numbers, Sample
from urdfsync.formats.urdf.artifacts import has_bench
from urdfsync.formats.urdf.artifacts import models as package_models
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    JOINT_KINDS,
    MOTION_KINDS,
    MOTIONS,
    Joint,
    JointType,
    Motion,
    Robot,
    limits_acceleration,
)

_VARIABLES: Mapping[Motion, tuple[str, str, str, str]] = {
    "rotational": ("revolute.phi", "revolute.w", "tau", "revolute.a"),
    "translational": ("prismatic.s", "prismatic.v", "f", "prismatic.a"),
}
"""Names of position and speed in a joint's model, of the effort at its flange, and of the acceleration in the model."""
_GENERIC_VARIABLES: Mapping[Motion, tuple[str, str, str]] = {
    "rotational": ("phi", "w_phi", "a_phi"),
    "translational": ("s", "v_s", "a_s"),
}
_UNITS: Mapping[Motion, tuple[str, str, str, str]] = {
    "rotational": ("rad", "rad/s", "N·m", "rad/s²"),
    "translational": ("m", "m/s", "N", "m/s²"),
}

_FREEDOMS: Mapping[JointType, int] = {"fixed": 0, "planar": 3, "floating": 6, "ball": 3}
"""Degrees of freedom of joint types that do not have exactly one."""


def bench(robot: Robot, target: Target, options: Options) -> Bench | None:
    """Return the bench of a robot: Test and Run of its package, else the generic robot; None without both."""
    assembly = Assembly(robot, options, target)
    layouts = {"package": _axes(assembly), "record": _generic_axes(assembly.tree)}
    axes = tuple(tuple(layout) for approach, layout in layouts.items() if approach in options.approach)
    generic = f"{target.name}Generic" if "record" in options.approach and has_bench(robot.joints, options) else ""
    if "package" in options.approach:
        return Bench(f"{target.name}Test", f"{target.name}Run", axes, tuple(_loops(assembly.tree)), generic)
    return Bench(generic, "", axes, generic=generic) if generic else None


def freedoms(robot: Robot, options: Options) -> int | None:
    """Return the degrees of freedom of a robot in its bench; None if it has no bench."""
    if "package" not in options.approach and not has_bench(robot.joints, options):
        return None
    closed = Assembly(robot, options).closed
    independent = (j for j in closed.tree.joints if j.mimic is None and j.name not in closed.dependent)
    base = _FREEDOMS["floating"] if options.base == "floating" else 0
    return base + sum(_FREEDOMS.get(joint.type, 1) for joint in independent)


def _loops(tree: KinematicTree) -> Iterator[LoopSignals]:
    for loop in tree.loops:
        name = tree.loop(loop.name).component
        force, torque = (tuple(f"{name}.{vector}[{i}]" for i in (1, 2, 3)) for vector in ("f", "t"))
        yield LoopSignals(f"loop {loop.name}", f"{name}.gap", force, torque)


def _axes(assembly: Assembly) -> Iterator[JointSignals]:
    """Yield the axes of a package's robot: joints with one degree of freedom, from the root outwards."""
    tree, drives, dependent = assembly.tree, assembly.connectors.drives, assembly.closed.dependent
    for joint in tree.joints:
        if motion := MOTION_KINDS.get(joint.type):
            name, drive = tree.joint(joint.name).component, drives.get(joint.name)
            position, velocity, effort, acceleration = _VARIABLES[motion]
            units, limits = _UNITS[motion], f"{name}.parameters.limits"
            range_ = (f"{limits}.lower", f"{limits}.upper") if JOINT_KINDS[joint.type].has_limits else ()
            motors = tuple(
                (f"{tree.joint(at).component}.parameters.transmission.{factor}", f"{other.motor}.tau")
                for at, other in drives.items()
                for moved, factor in ((at, "reduction"), (other.other, "otherReduction"))
                if other.motor and moved == joint.name
            )
            yield JointSignals(
                f"joint {joint.name}",
                Signal(f"{name}.{position}", units[0], range_),
                Signal(f"{name}.{velocity}", units[1], (f"{limits}.velocity",)),
                Signal(f"{drive.axis}.{effort}", units[2], (f"{limits}.effort",), motors) if drive else None,
                _acceleration(joint, f"{name}.{acceleration}", limits),
                joint.name in dependent,
            )


def _generic_axes(tree: KinematicTree) -> Iterator[JointSignals]:
    """Yield the axes of the generic robot. Turning and sliding axes are numbered separately."""
    for motion in MOTIONS:
        for number, joint in enumerate(tree.axes(motion), 1):
            position, speed, acceleration = _GENERIC_VARIABLES[motion]
            units, limits = _UNITS[motion], f"data.{tree.joint(joint.name).component}.limits"
            range_ = (f"{limits}.lower", f"{limits}.upper") if JOINT_KINDS[joint.type].has_limits else ()
            yield JointSignals(
                f"joint {joint.name}",
                Signal(f"{position}[{number}]", units[0], range_),
                Signal(f"{speed}[{number}]", units[1], (f"{limits}.velocity",)),
                Signal(f"{motion}Axis[{number}].{_VARIABLES[motion][2]}", units[2], (f"{limits}.effort",)),
                _acceleration(joint, f"{acceleration}[{number}]", limits),
            )


def _acceleration(joint: Joint, variable: str, limits: str) -> Signal | None:
    if not limits_acceleration(joint):
        return None
    return Signal(variable, _UNITS[MOTION_KINDS[joint.type]][3], (f"{limits}.deceleration", f"{limits}.acceleration"))


def numbers(sample: Sample, robot: Robot, *packages: Mapping[str, bytes]) -> Sequence[Numbers]:
    """Return the numbers of packages and the first reading `robot`, compared with the second reading of the source."""
    from urdfsync.formats.urdf.second.comparison import compare_numbers  # a late import saves builds most of a second

    return compare_numbers(sample, robot, packages)


def models(robot: Robot, target: Target, options: Options) -> Sequence[str]:
    """Return the classes of the robot and its benches; without a robot model, the record."""
    return package_models(robot.joints, target, options)


def experiment(sample: Sample, step: float | None = None) -> Experiment | str:
    """Return the comparison with Pinocchio, or the reason why no comparison is possible, such as a planar joint."""
    from urdfsync.formats.urdf.physics.experiment import experiment  # a late import: no build needs numpy

    return experiment(sample, step)
