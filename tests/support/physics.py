"""Packages put to the test by their domain's experiment, many in one process of the compiler."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from support import urdfs
from support.modelica import Run, Task, simulate
from support.packages import Package, generate
from urdfsync.check.results import agrees, largest
from urdfsync.domain import Deviation, Experiment, Quantity, Target
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.physics import motion, probe
from urdfsync.urdf.physics.reading import read
from urdfsync.urdf.physics.reference import Instant, Reference


@dataclasses.dataclass(frozen=True)
class Case:
    """An experiment, and the package that it is done with."""

    experiment: Experiment
    package: Package


def prepare(source: bytes | Path, name: str = "Bot", *, complete: bool = True, **options: Any) -> Case:
    """The experiment with a URDF, and the package that follows from it; meshes are imported beside a file only."""
    content = source if isinstance(source, bytes) else source.read_bytes()
    target = Target(name, name)
    experiment = DOMAIN.experiment(content, "robot.urdf", target, Options(**options), complete)
    assert experiment is not None
    if experiment.content != content:
        source = experiment.content
    return Case(experiment, generate(source, target, **options))


def compare(library: Path, folder: Path, cases: Sequence[Case]) -> list[tuple[Deviation, ...]]:
    """Simulate the probes of packages with names of their own, below `folder`: how far each is from the reference."""
    folders = [case.package.write(folder) for case in cases]
    probes = [case.experiment.probe for case in cases]
    tasks = [Task(p.source, p.model, [Run(p.stop, p.step)], p.values) for p in probes]
    results = []
    for case, run in zip(cases, simulate(library, folders, tasks), strict=True):
        series = {"time": run.times.tolist()} | {name: values.tolist() for name, values in run.values.items()}
        results.append(tuple(case.experiment.compare(series)))
    return results


def fault(deviations: Sequence[Deviation]) -> Deviation | None:
    """The difference that is greatest against its kind, if one is beyond the tolerance."""
    return None if all(map(agrees, deviations)) else largest(deviations, tuple(Quantity))


def pinocchio_series(urdf: str) -> dict[str, list[float]]:
    """What a simulation of the probe would give if it were Pinocchio's; free joints stay as they begin."""
    skeleton = KinematicTree.of(urdfs.parsed(urdf))
    axes, free = motion.driven_axes(skeleton), motion.free_joints(skeleton)
    names = [[joint.name for joint in joints] for joints in (axes, free)]
    reference = Reference(read(urdf.encode(), "robot.urdf"), *names)
    starts = {joint.name: reference.start(joint.name, motion.free_start(joint)) for joint in free}
    courses = [motion.axis_course(joint) for joint in axes]
    series: dict[str, list[float]] = {}
    for time in (0.0, motion.duration(skeleton)):
        instant = reference.solve(reference.state(time, courses, starts))
        for name, value in {"time": time, **_values(skeleton, instant)}.items():
            series.setdefault(name, []).append(float(value))
    return series


def _values(skeleton: KinematicTree, instant: Instant) -> dict[str, float]:
    """What Pinocchio says, by the names of the probe's values."""
    mass, centre = instant.mass_and_centre()
    names = probe.robot_variables(skeleton, Target("Bot", "Bot"), Options())
    pairs: list[tuple[Sequence[str], Any]] = [
        (tuple(names.efforts(skeleton).values()), instant.efforts),
        (probe.FORCE, -instant.force),
        (probe.TORQUE, -instant.torque),
        (probe.MASS, [mass]),
        (probe.MOMENT, mass * centre),
    ]
    for link in skeleton.links:
        frame, (linear, angular) = instant.frame(link.name), instant.acceleration(link.name)
        pairs += [(names.axes[link.name], frame.axes.T.ravel()), (names.places[link.name], frame.place)]
        parts = {"v_0": frame.velocity, "w_a": frame.axes.T @ frame.turning, "a_0": linear, "z_a": angular}
        pairs += [(names.of_body(link.name, part), values) for part, values in parts.items()]
    return {name: value for called, values in pairs for name, value in zip(called, values, strict=True)}
