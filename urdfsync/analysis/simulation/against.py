"""Simulates a model as it is, and as it was in a git revision, and compares the motion of each joint."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import msgspec
import numpy as np

from urdfsync.analysis.simulation.package import Prepared, prepare
from urdfsync.analysis.simulation.results import (
    Against,
    JointDifference,
    JointResult,
    QuantityDifference,
    Range,
    Series,
    SimulateOptions,
    SimulateResult,
)
from urdfsync.analysis.simulation.run import simulate_prepared
from urdfsync.common.diagnostics import ConfigError, UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.engine.options import Progress
from urdfsync.engine.renames import find_matching
from urdfsync.project.config import Config, RobotConfig, load
from urdfsync.project.git.revisions import Revision


def simulate_against(
    config: Config, robot: RobotConfig, options: SimulateOptions, progress: Progress
) -> SimulateResult:
    """Simulate a model, and the same model of the revision `options.against` with the same settings.

    The revision is checked out to a temporary folder: its package, its configuration and the user's models are those
    of that time. Raises UrdfsyncError, also for faults of the revision; those name its files.
    """
    revision = Revision(config.root, str(options.against))
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as scratch:
        with _told_of(revision, scratch):
            former_config, former_robot = _check_out(revision, Path(scratch), config, robot)
            former_prepared = prepare(former_config, former_robot, options)
        prepared = prepare(config, robot, options)
        now = simulate_prepared(robot, prepared, options, progress)
        same = msgspec.structs.replace(options, stop=now.stop, step=now.step, tolerance=now.tolerance)
        with _told_of(revision, scratch):
            former = simulate_prepared(former_robot, former_prepared, same, progress)
    against, series = _compare(revision.name, now, former, _former_names(robot, prepared, former_prepared))
    return msgspec.structs.replace(
        now,
        against=against,
        former=series,
        seconds=now.seconds + former.seconds,
        is_known=now.is_known and former.is_known,
    )


def _check_out(revision: Revision, scratch: Path, config: Config, robot: RobotConfig) -> tuple[Config, RobotConfig]:
    """Return the configuration and the robot of a revision, checked out to a folder. Raises UrdfsyncError."""
    revision.read(config.file)  # tells a revision without the configuration
    revision.export(scratch)
    former = load(scratch / Path(os.path.realpath(config.file)).relative_to(revision.top))
    return former, former.select_one([robot.name], "simulate")


@contextlib.contextmanager
def _told_of(revision: Revision, scratch: str) -> Iterator[None]:
    """Let errors name the files of the revision instead of their copies."""
    try:
        yield
    except UrdfsyncError as error:
        places = {f"{shown(Path(scratch))}/": f"{revision.name}:", f"{scratch}/": f"{revision.name}:"}
        findings = []
        for finding in error.diagnostics:
            file, message = finding.file, finding.message
            for place, name in places.items():
                file, message = file.replace(place, name), message.replace(place, name)
            hint = "name a revision with a built package" if finding.code == "not-built" else finding.hint
            if not file.startswith(f"{revision.name}:"):
                message = f"in {revision.name}, {message}"
            findings.append(msgspec.structs.replace(finding, file=file, message=message, hint=hint))
        raise UrdfsyncError(*findings) from None


def _former_names(robot: RobotConfig, now: Prepared, former: Prepared) -> Mapping[str, str]:
    """Return the former names of renamed elements, in the domain's words: `joint elbow`."""
    snapshots = [each.package.generation.now.snapshot for each in (former, now)]
    renames = find_matching(now.package.inputs.domain, snapshots[0], snapshots[1], robot.renamed).renames
    return {f"{kind} {new}": f"{kind} {old}" for (kind, old), new in renames.items()}


def _compare(
    name: str, now: SimulateResult, former: SimulateResult, names: Mapping[str, str]
) -> tuple[Against, Series]:
    """Return the differences of all joints, and the former series by the names of today's variables."""
    formers = {(joint.robot, joint.element): joint for joint in former.joints}
    differences, missing, series = list[JointDifference](), list[str](), {"time": former.series["time"]}
    for joint in now.joints:
        element = names.get(joint.element, joint.element)
        if (before := formers.pop((joint.robot, element), None)) is None:
            missing.append(joint.element)
            continue
        found = []
        for quantity, new, old in _pairs(joint, before):
            series[new.variable] = former.series[old.variable]
            found.append(_difference(quantity, (now.series, new), (former.series, old)))
        differences.append(JointDifference(joint.element, joint.robot, element, tuple(found)))
    if not differences:
        raise ConfigError.of("against", f"`{now.model}` has no joint that the model of {name} has", hint="see `diff`")
    missing += [joint.element for joint in formers.values()]
    return Against(name, tuple(differences), tuple(missing)), series


def _pairs(joint: JointResult, former: JointResult) -> Iterator[tuple[str, Range, Range]]:
    for quantity in ("position", "speed", "effort"):
        new, old = getattr(joint, quantity), getattr(former, quantity)
        if new is not None and old is not None:
            yield quantity, new, old


def _difference(quantity: str, now: tuple[Series, Range], former: tuple[Series, Range]) -> QuantityDifference:
    """Return the difference of one quantity, up to the end of the shorter simulation."""
    count = min(len(series["time"]) for series, _ in (now, former))
    new, old = (np.array(series[each.variable][:count]) for series, each in (now, former))
    sizes = np.abs(new - old)
    worst = int(sizes.argmax())
    ends = former[1].least, former[1].greatest
    return QuantityDifference(quantity, now[1].unit, float(sizes[worst]), now[0]["time"][worst], *ends)
