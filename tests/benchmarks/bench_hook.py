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
import struct
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rich.console import Console
from rich.progress import track
from support import corpus
from support.timing import NOTHING, seconds, table

ROBOTS = corpus.REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots"
ARM = ROBOTS / "six_axis_arm" / "six_axis_arm.urdf"
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
    console.print(table(rounds[1:]))  # the first round fills caches


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
    measured = {NOTHING: _run([sys.executable, "-c", "pass"], Path.cwd())}
    for label, place in places.items():
        measured[f"{label}: build --check"] = _run(BUILD_CHECK, place)
        measured[f"{label}: hook"] = _run(CHECK, place)
        measured[f"{label}: hook, another file changed"] = _changed(place, "notes.txt")
        measured[f"{label}: hook, a source changed"] = _changed(place, "arm0.urdf")
    return measured


def _changed(place: Path, name: str) -> float:
    """The time while a file has a change that is not staged."""
    path = place / name
    content = path.read_bytes()
    path.write_bytes(content.replace(b'mass value="', b'mass value="1') + b"\n")
    try:
        return _run(CHECK, place)
    finally:
        path.write_bytes(content)
        _run(["git", "update-index", "-q", "--refresh"], place)


def _run(command: Sequence[str], folder: Path) -> float:
    """Seconds of a process; what a hook of git that runs the benchmark has set must not decide."""
    return seconds(command, folder, {name: value for name, value in os.environ.items() if not name.startswith("GIT_")})


if __name__ == "__main__":
    main()
