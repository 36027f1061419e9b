"""Whole-process time of the hooks' entry when nothing changed, beside that of Python doing nothing.

    python tests/benchmarks/bench_hook.py [--runs N]

Every round takes each measurement once, in turn, so that other load on the machine meets all of them alike. A ratio
is that to `python -c pass` of the same round. Repositories: one robot, ten robots, and one robot whose meshes have
200 MB; each committed, in step. `urdfsync build --check` stands beside them, and a file changed that does not
matter, and one that does, so that what is staged is judged in a mirror.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rich.console import Console
from rich.progress import track
from rich.table import Table
from support import corpus

ROBOTS = corpus.REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots"
ARM = ROBOTS / "six_axis_arm" / "six_axis_arm.urdf"
NOTHING = "python -c pass"
MESH = 10 * 1024 * 1024
"""Bytes of each of the large meshes."""

_HOOK = "import sys; from urdfsync.hook import main; sys.exit(main())"
CHECK = [sys.executable, "-c", _HOOK, "check"]
BUILD_CHECK = [sys.executable, "-m", "urdfsync", "build", "--check", "--quiet"]


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=9, help="how often to measure everything (default: 9)")
    runs = parser.parse_args().runs
    console = Console()
    with tempfile.TemporaryDirectory() as folder:
        places = {
            "1 robot": _repository(Path(folder) / "one", 1),
            "10 robots": _repository(Path(folder) / "ten", 10),
            "200 MB of meshes": _repository(Path(folder) / "large", 1, meshes=20),
        }
        rounds = [_round(places) for _ in track(range(runs + 1), "measuring", console=console, transient=True)]
    console.print(_table(rounds[1:]))  # the first round fills caches


def _repository(folder: Path, robots: int, meshes: int = 0) -> Path:
    """A repository of copies of the arm, built and committed; `meshes` is the number of large ones."""
    folder.mkdir()
    text = ARM.read_text(encoding="utf-8")
    shutil.copytree(ARM.parent, folder, dirs_exist_ok=True)
    for number in range(meshes):
        (folder / f"large{number}.stl").write_bytes(bytes(80) + _triangles(number))
        name = f"large{number}"
        visual = f'<visual><geometry><mesh filename="{name}.stl"/></geometry></visual>'
        ends = f'<parent link="base_link"/><child link="{name}"/>'
        link, joint = f'<link name="{name}">{visual}</link>', f'<joint name="to_{name}" type="fixed">{ends}</joint>'
        text = text.replace("</robot>", f"{link}{joint}</robot>")
    configuration = []
    for number in range(robots):
        (folder / f"arm{number}.urdf").write_text(text, encoding="utf-8")
        configuration.append(f'[robots.arm{number}]\nsource = "arm{number}.urdf"\npackage = "Arm{number}"\n')
    (folder / "urdfsync.toml").write_text("".join(configuration), encoding="utf-8")
    (folder / "notes.txt").write_text("notes\n", encoding="utf-8")
    _run([sys.executable, "-m", "urdfsync", "build", "--quiet"], folder)
    for command in (
        ["init", "-q"],
        ["add", "."],
        ["-c", "user.name=b", "-c", "user.email=b@c", "commit", "-qm", "all"],
    ):
        _run(["git", *command], folder)
    return folder


def _triangles(seed: int) -> bytes:
    """A binary STL after its header: random triangles."""
    count, numbers = MESH // 50, random.Random(seed)
    triangles = (struct.pack("<12fH", *(numbers.random() for _ in range(12)), 0) for _ in range(count))
    return count.to_bytes(4, "little") + b"".join(triangles)


def _round(places: Mapping[str, Path]) -> dict[str, float]:
    """Seconds of every measurement, by its label."""
    seconds = {NOTHING: _seconds([sys.executable, "-c", "pass"], Path.cwd())}
    for label, place in places.items():
        seconds[f"{label}: build --check"] = _seconds(BUILD_CHECK, place)
        seconds[f"{label}: hook"] = _seconds(CHECK, place)
        seconds[f"{label}: hook, another file changed"] = _changed(place, "notes.txt")
        seconds[f"{label}: hook, a source changed"] = _changed(place, "arm0.urdf")
    return seconds


def _changed(place: Path, name: str) -> float:
    """The time while a file has a change that is not staged."""
    path = place / name
    content = path.read_bytes()
    path.write_bytes(content.replace(b'mass value="', b'mass value="1') + b"\n")
    try:
        return _seconds(CHECK, place)
    finally:
        path.write_bytes(content)
        _run(["git", "update-index", "-q", "--refresh"], place)


def _seconds(command: Sequence[str], folder: Path) -> float:
    """Wall-clock time of a process, from before its start to its end."""
    started = time.perf_counter()
    _run(command, folder)
    return time.perf_counter() - started


def _run(command: Sequence[str], folder: Path) -> None:
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL, env=environment)


def _table(rounds: Sequence[Mapping[str, float]]) -> Table:
    table = Table(title=f"whole-process time, {len(rounds)} rounds")
    table.add_column("what")
    for heading in ("median, ms", "least to most, ms", f"times {NOTHING}"):
        table.add_column(heading, justify="right")
    for label in rounds[0]:
        times = [1000 * seconds[label] for seconds in rounds]
        ratio = statistics.median(seconds[label] / seconds[NOTHING] for seconds in rounds)
        table.add_row(label, f"{statistics.median(times):.0f}", f"{min(times):.0f} to {max(times):.0f}", f"{ratio:.1f}")
    return table


if __name__ == "__main__":
    main()
