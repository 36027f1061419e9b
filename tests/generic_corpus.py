"""The generic robots and the corpus: functions against Pinocchio, and times beside the package.

- `python tests/generic_corpus.py functions [--only TEXT …] [--most N]`: mass matrix, forces, poses and the Jacobian of
  every link in random configurations, for every robot in scope that has at most N moving joints;
- `… times [FILE …] [--repeats N]`: compiles and simulates the same motion of package and generic robots, in turn, and
  prints rows for the User's Guide.

`tests/check_corpus.py --approach record` compares prescribed motion. Files without inertias get made-up ones, for all
sides. Exits with 1 if anything differs or fails.
"""

from __future__ import annotations

import argparse
import os
import statistics
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from support import corpus, generic, physics
from support.corpus import REPOSITORY
from support.functions import Functions
from support.modelica import Outcome, Run, Task, compile_task, execute
from support.packages import Package, generate

from urdfsync.check.libraries import find_standard_library
from urdfsync.domain import Target
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.tables import obstacles
from urdfsync.urdf.parse.source import read_robot
from urdfsync.urdf.physics import completion, motion
from urdfsync.urdf.robot import MOTION_KINDS

COUNTED = ("file", "moving joints", "axes", "links")
FUNCTIONS = ("found", "mass", "inertias", "bias", "gravity", "jacobian", "places", "turns")
"""Base and tool link, mass matrix, its diagonal, all forces, those of gravity, Jacobians of all links, and poses."""
EXACT = 1e-12
APPROACHES = ("package", *generic.FORMS)
TIMED = tuple(
    corpus.FOLDER / file
    for file in (
        "robots/ros-industrial/xacro_generated/universal_robots/ur_description/urdf/ur5e.urdf",
        "robots/ros-industrial/xacro_generated/fanuc/fanuc_m900ib_support/urdf/m900ib700.urdf",
        "histories/kscalelabs+sim__sim_resources_stompymicro_robot_fixed.urdf/000.urdf",
        "robots/matlab/Atlas/urdf/atlas.urdf",
    )
)
"""Robots with 6, 12, 16 and 30 moving joints; of the 12, 6 follow others."""


def main(arguments: Sequence[str]) -> int:
    """Print a table with a row per robot, as soon as it is known."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("functions", "times"))
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--only", nargs="*", default=[], metavar="TEXT")
    parser.add_argument("--most", type=int, default=1000, metavar="N")
    parser.add_argument("--repeats", type=int, default=1, metavar="N")
    options = parser.parse_args(arguments)
    folder = find_standard_library(os.environ).parts["Modelica"].parent
    if options.what == "times":
        return int(not _times(folder, options.files or TIMED, options.repeats))
    return int(not _functions(folder, options.files or _all(options)))


def _all(options: argparse.Namespace) -> list[Path]:
    """Robots of the corpus in scope, the smallest first."""
    counts = {corpus.FOLDER / file: count for file, count in corpus.moving_joints().items() if count <= options.most}
    files = [file for file in counts if not options.only or any(text in str(file) for text in options.only)]
    return sorted(filter(_in_scope, files), key=lambda file: (counts[file], str(file)))


def _in_scope(file: Path) -> bool:
    robot = read_robot(file.read_bytes(), file.name, cross_check=False).robot
    return robot is not None and not obstacles(robot.joints)


def _functions(standard: Path, files: Iterable[Path]) -> bool:
    _row("file", "moving joints", "axes", "links", *(f"{part} error" for part in FUNCTIONS))
    _row(*["---"] * (4 + len(FUNCTIONS)))
    good = [_computed(standard, file) for file in files]
    return _all_good(good)


def _computed(standard: Path, file: Path) -> bool | None:
    """One row of `functions`; None for a robot that could not be compared."""
    functions = Functions(_complete(file))
    if not any(joint.type in MOTION_KINDS for joint in functions.robot.skeleton.joints):
        _row(_name(file), *_counts(functions.robot.skeleton), "nothing moves", *[""] * (len(FUNCTIONS) - 1))
        return None
    with tempfile.TemporaryDirectory() as folder:
        worst = functions.worst(standard, Path(folder))
    _row(_name(file), *_counts(functions.robot.skeleton), *(f"{worst[part]:.0e}" for part in FUNCTIONS))
    return max(worst.values()) < EXACT


def _times(standard: Path, files: Iterable[Path], repeats: int) -> bool:
    """A table, and at the end its rows for the User's Guide."""
    _row(*COUNTED, "motion", *(f"{form}, CPU s" for form in APPROACHES))
    _row(*["---"] * 8)
    rows = [row for file in files for row in _timed(standard, file, repeats)]
    print("", *filter(None, rows), sep="\n")  # noqa: T201
    return all(rows)


def _timed(standard: Path, file: Path, repeats: int) -> Iterator[str]:
    """What the guide says of a robot; an empty text if something went wrong.

    Each robot is compiled in a process of its own that has loaded the libraries already, and package and generic
    robots take turns; times are medians of the CPU times of these processes.
    """
    content = _complete(file)
    yield from _written(file)
    for kind in ("driven", "free"):
        jobs = {form: _job(content, form, kind) for form in APPROACHES}
        outcomes: dict[str, list[Outcome]] = {form: [] for form in APPROACHES}
        for _ in range(repeats):
            for form, (package, task) in jobs.items():
                with tempfile.TemporaryDirectory() as folder:
                    warm = compile_task("UrdfSync.Examples.DoublePendulum")
                    outcomes[form].append(execute(standard, [package.write(Path(folder))], [warm, task])[-1])
        problems = [one.error or one.runs[0].error for several in outcomes.values() for one in several]
        times = {form: _medians(several) for form, several in outcomes.items()}
        cells = [f"{compiling:.1f} + {simulating:.1f}" for compiling, simulating in times.values()]
        skeleton = jobs["package"][0].skeleton
        _row(_name(file), *_counts(skeleton), kind, *cells, *filter(None, problems))
        joints, *_ = _counts(skeleton)
        ratio = sum(times["GenericRobot"]) / sum(times["package"])
        row = f"<td>compile + simulate, {joints} moving joints, {kind}</td><td>{cells[0]} s</td>"
        yield "" if any(problems) else f"<tr>{row}<td>{cells[1]} s ({100 * ratio:.0f} %)</td></tr>"


def _medians(outcomes: Sequence[Outcome]) -> tuple[float, float]:
    """Of compiling and of simulating."""
    compiling = statistics.median(one.compiling for one in outcomes)
    return compiling, statistics.median(one.seconds - one.compiling for one in outcomes)


def _all_good(rows: Sequence[bool | None]) -> bool:
    """Whether every robot that could be compared agrees; says how many those are."""
    print(f"\n{rows.count(True)} agree, {rows.count(False)} do not, {rows.count(None)} could not be compared")  # noqa: T201
    return False not in rows and True in rows


def _job(content: bytes, form: str, kind: str) -> tuple[Package, Task]:
    """A package, and a motion of 0.01 s: of all axes as `check` prescribes it, or free from its start."""
    approach = ("package",) if form == "package" else ("record",)
    if kind == "free":
        robot = generic.prepare(content, approach=approach)
        start = [motion.axis_course(joint)._replace(acceleration=0) for joint in motion.driven_axes(robot.skeleton)]
        return robot.package, generic.free_task(robot, form, start, 0.01)
    case = physics.prepare(content, complete=False, approach=approach)
    probe = case.experiment.probe
    source = probe.source.replace("UrdfSync.Robots.GenericRobot ", f"UrdfSync.Robots.{form} ")
    return case.package, Task(source, probe.model, [Run(probe.stop, probe.step)], probe.values)


def _written(file: Path) -> Iterator[str]:
    """Text files and their lines."""
    texts = [generate(file, Target("Bot", "Bot"), approach=(name,)).texts for name in ("package", "record")]
    robot = read_robot(file.read_bytes(), file.name, cross_check=False).robot
    assert robot is not None
    what = f"{sum(joint.type in MOTION_KINDS for joint in robot.joints)} moving joints, {len(robot.links)} links"
    files = "".join(f"<td>{len(files)}</td>" for files in texts)
    lines = "".join(f"<td>{sum(text.count(chr(10)) for text in files.values()):,}</td>" for files in texts)
    yield f"<tr><td>text files, {what}</td>{files}</tr>"
    yield f"<tr><td>their lines</td>{lines}</tr>"


def _complete(file: Path) -> bytes:
    """The file as Pinocchio reads it, with inertias."""
    content = completion.completed_for_pinocchio(file.read_bytes()).content
    robot = read_robot(content, file.name, cross_check=False).robot
    assert robot is not None
    return completion.with_inertias(content, KinematicTree.of(robot)).content


def _counts(skeleton: KinematicTree) -> Iterator[str]:
    yield str(sum(joint.type in MOTION_KINDS for joint in skeleton.joints))
    yield str(len(motion.driven_axes(skeleton)))
    yield str(len(skeleton.links))


def _name(file: Path) -> str:
    known = next((folder for folder in (corpus.FOLDER, REPOSITORY) if file.is_relative_to(folder)), file.parent)
    return file.relative_to(known).as_posix()


def _row(*cells: str) -> None:
    print(f"| {' | '.join(cells)} |", flush=True)  # noqa: T201


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
