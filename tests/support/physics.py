"""Packages put to the test by their domain's experiment, many in one process of the compiler."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from support import urdfs
from support.modelica import Run, Task, execute
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


@dataclasses.dataclass(frozen=True)
class Deviations:
    """How far a package is from the reference, element by element."""

    deviations: tuple[Deviation, ...]

    @property
    def agrees(self) -> bool:
        """Whether all differences are within the tolerance."""
        return all(map(agrees, self.deviations))

    def worst(self, quantities: Sequence[Quantity] = tuple(Quantity)) -> Deviation | None:
        """The one that is greatest against its kind; None if nothing of these quantities was compared."""
        return largest(self.deviations, quantities)


def prepare(source: bytes | Path, name: str = "Bot", *, complete: bool = True, **options: Any) -> Case:
    """The experiment with a URDF, and the package that follows from it; meshes are imported beside a file only."""
    content = source if isinstance(source, bytes) else source.read_bytes()
    target = Target(name, name)
    experiment = DOMAIN.experiment(content, "robot.urdf", target, Options(cross_check=False, **options), complete)
    assert experiment is not None
    if experiment.content != content:
        source = experiment.content
    return Case(experiment, generate(source, target, **options))


def changed(case: Case, path: str, change: Callable[[str], str]) -> Case:
    """The same with another text in one file of the package."""
    texts = {**case.package.texts, path: change(case.package.texts[path])}
    return Case(case.experiment, dataclasses.replace(case.package, texts=texts))


def replaced(old: str, new: str) -> Callable[[str], str]:
    """A change of one place in a text."""

    def change(text: str) -> str:
        assert text.count(old) == 1, f"{old!r} is not once in:\n{text}"
        return text.replace(old, new)

    return change


def compare(library: Path, folder: Path, cases: Iterable[Case]) -> list[Deviations]:
    """Simulate the probes of packages with names of their own, below `folder`, and compare."""
    cases = list(cases)
    folders = [case.package.write(folder) for case in cases]
    probes = [case.experiment.probe for case in cases]
    tasks = [Task(p.source, p.model, [Run(p.stop, p.step)], p.values) for p in probes]
    results = []
    for case, outcome in zip(cases, execute(library, folders, tasks), strict=True):
        assert not outcome.error, outcome.error
        (run,) = outcome.runs
        assert not run.error, run.error
        series = {"time": run.times.tolist()} | {name: values.tolist() for name, values in run.values.items()}
        results.append(Deviations(tuple(case.experiment.compare(series))))
    return results


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
