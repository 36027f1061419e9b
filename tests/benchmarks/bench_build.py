"""Whole-process time of `urdfsync build`, fresh and with nothing to do, beside that of Python doing nothing.

    python tests/benchmarks/bench_build.py [--runs N]

Every round takes each measurement once, in turn, so that other load on the machine meets all of them alike. A ratio
is that to `python -c pass` of the same round. Robots: the examples of the library, and of the corpus (see
`support.corpus`) the UR5e and the robot with the most links.
"""

from __future__ import annotations

import argparse
import dataclasses
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rich.console import Console
from rich.progress import track
from support import corpus
from support.timing import NOTHING, seconds, table

EXAMPLE = corpus.REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm" / "six_axis_arm.urdf"
UR5E = "universal_robots/ur_description/urdf/ur5e.urdf"


@dataclasses.dataclass(frozen=True)
class Robot:
    """A robot to build."""

    label: str
    source: Path
    links: int


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=9, help="how often to measure everything (default: 9)")
    runs = parser.parse_args().runs
    console = Console()
    with tempfile.TemporaryDirectory() as folder:
        robots = list(_robots())
        rounds = [
            _round(robots, Path(folder) / str(number))
            for number in track(range(runs + 1), "measuring", console=console, transient=True)
        ]
    console.print(table(rounds[1:]))  # the first round fills caches
    if len(robots) == 1:
        console.print("no corpus of robots: set URDFSYNC_CORPUS")


def _robots() -> Iterator[Robot]:
    yield _robot("six_axis_arm", EXAMPLE)
    found = [corpus.FOLDER / file for file in corpus.robots() if file != corpus.ABSENT]
    yield from (_robot("ur5e", path) for path in found if path.as_posix().endswith(UR5E))
    readable = [path for path in found if _is_built(path)]
    if readable:
        largest = max(readable, key=_links)
        yield _robot(largest.stem, largest)


def _robot(name: str, source: Path) -> Robot:
    links = _links(source)
    return Robot(f"{name}, {links} links", source, links)


def _links(source: Path) -> int:
    return source.read_bytes().count(b"<link ")


def _is_built(source: Path) -> bool:
    """Whether a package can be made of it at all."""
    from urdfsync.urdf.source import read_robot

    return read_robot(source.read_bytes(), source.name, cross_check=False).robot is not None


def _round(robots: Sequence[Robot], folder: Path) -> dict[str, float]:
    """Seconds of every measurement, by its label."""
    measured = {NOTHING: seconds([sys.executable, "-c", "pass"], Path.cwd())}
    for robot in robots:
        project = folder / robot.source.stem
        project.mkdir(parents=True)
        configuration = f'[robots.robot]\nsource = "{robot.source.as_posix()}"\npackage = "Robot"\n'
        (project / "urdfsync.toml").write_text(configuration, encoding="utf-8")
        build = [sys.executable, "-m", "urdfsync", "build", "--quiet"]
        measured[f"{robot.label}: fresh"] = seconds(build, project)
        measured[f"{robot.label}: no-op"] = seconds(build, project)
    shutil.rmtree(folder)
    return measured


if __name__ == "__main__":
    main()
