"""What is compiled and compared of a robot's package; `urdfsync.checks.experiment.Checks` describes the functions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from urdfsync.checks.experiment import Deviation, Experiment, Sample
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Snapshot, Target
from urdfsync.urdf import artifacts, benches
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options
from urdfsync.urdf.snapshot import from_snapshot, joints_of


def cross_check(content: bytes, file: str) -> Sequence[Diagnostic]:
    """Return the differences from the links, joints and poses that yourdfpy reads."""
    from urdfsync.urdf.parse.second_reader import cross_check  # most of a second, which no build needs

    return cross_check(content, file)


def models(snapshot: Snapshot, target: Target, options: Options) -> Sequence[str]:
    """Return the robot, its benches, and the record if there is no robot."""
    return artifacts.models(joints_of(snapshot["joints"]), target, options)


def freedoms(snapshot: Snapshot, options: Options) -> int | None:
    """Return the degrees of freedom, of a robot that has Test or the bench of the generic robot."""
    return benches.freedoms(KinematicTree.of(from_snapshot(snapshot)), options)


def experiment(sample: Sample, step: float | None = None) -> Experiment | str:
    """Return the comparison with Pinocchio, or why a robot has none, such as one with planar or floating joints."""
    from urdfsync.urdf.physics.experiment import experiment  # with numpy, which no build needs

    return experiment(sample, step)


def wiring(texts: Mapping[str, bytes], snapshot: Snapshot, target: Target, options: Options) -> Iterable[Deviation]:
    """Look at the connections of Run and Test, which only the package approach has."""
    from urdfsync.urdf.physics.wiring import wiring  # no build needs it

    tree = KinematicTree.of(from_snapshot(snapshot), (target.name,))
    return wiring(texts, tree, target, options) if "package" in options.approach else ()
