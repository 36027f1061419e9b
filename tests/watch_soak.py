"""`urdfsync watch` under random edits by two writers and a hand editor; at the end nothing may be lost or stale.

    python tests/watch_soak.py [MINUTES [SEED]]

One writer exports as CAD programs do, in place and in pieces; the other saves as editors do, or replaces the whole
folder, and changes the mesh. The hand editor writes comments into generated files, deletes some, and builds by hand.
At the end each package has to equal a fresh build of its source but for the comments, and no comment may be missing.
The exit code is 1 if anything is wrong. `tests/watch/test_watch_soak.py` runs it for half a minute, and in
CI for three.
"""

from __future__ import annotations

import dataclasses
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from random import Random

from support.daemon import REPOSITORY, Watch

ROBOT = REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm" / "six_axis_arm.urdf"
ROBOTS = ("arm", "leg")
CONFIG = '[robots.{0}]\nsource = "{1}/{0}.urdf"\npackage = "{2}"\non_conflict = "merge"\n'
TAG = re.compile(r"// mine \d+")
_QUIET = 5.0
"""Seconds that all is left alone at the end."""
_EXTRA = (
    '<link name="{0}"><inertial><mass value="{1}"/>'
    '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
    '<joint name="{0}_joint" type="fixed"><parent link="{2}"/><child link="{0}"/></joint>'
)


@dataclasses.dataclass
class Soak:
    """What happened, and what is wrong."""

    counts: Counter[str] = dataclasses.field(default_factory=Counter)
    problems: list[str] = dataclasses.field(default_factory=list)


def run(folder: Path, seconds: float, seed: int) -> Soak:
    """Let all of them work in a new project for so long, then compare."""
    soak, random = Soak(), Random(seed)
    project = _project(folder / "project", random)
    with Watch(project, "--rescan", "5") as watch:
        watch.rest(robots=len(ROBOTS))
        hand = _Hand(project, Random(seed + 1), soak)
        steps: Sequence[Callable[[], None]] = (
            _Exporter(project / "cad/arm.urdf", Random(seed + 2), soak).step,
            _Saver(project / "export/leg.urdf", Random(seed + 3), soak).step,
            hand.step,
        )
        _all_at_once(steps, seconds, soak)
        time.sleep(_QUIET)
        watch.rest()
        if watch.process.poll() is not None or watch.stop() != 0 or watch.errors:
            soak.problems.append(f"the daemon ended badly:\n{watch.said}")
        soak.counts.update(f"event {event['event']}" for event in watch.events)
        failed = [event for event in watch.events if event["event"] == "failed"]
        soak.problems += [f"failed: {event['diagnostics']}" for event in failed]
    soak.problems += _compare(project, folder / "fresh", hand.tags)
    return soak


def _all_at_once(steps: Sequence[Callable[[], None]], seconds: float, soak: Soak) -> None:
    end = time.monotonic() + seconds

    def repeat(step: Callable[[], None]) -> None:
        try:
            while time.monotonic() < end:
                step()
        except Exception as error:  # noqa: BLE001 - of a thread, and told in the end
            soak.problems.append(f"{step.__qualname__}: {error!r}")

    threads = [threading.Thread(target=repeat, args=[step]) for step in steps]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


class _Writer:
    """Writes random variants of a robot."""

    def __init__(self, source: Path, random: Random, soak: Soak) -> None:
        self._source, self._random, self._soak = source, random, soak

    def step(self) -> None:
        """Write a variant in some way, then wait a little."""
        way = self._random.choice([name for name in dir(self) if name.startswith("by_")])
        self._soak.counts[way] += 1
        getattr(self, way)(variant(self._random))
        time.sleep(self._random.choice([0.05, 0.4, 0.8, 1.5, 2.5]))


class _Exporter(_Writer):
    def by_writing_at_once(self, text: str) -> None:
        self._source.write_text(text)

    def by_writing_in_pieces(self, text: str) -> None:
        with self._source.open("w") as file:
            for begin in range(0, len(text), 4000):
                file.write(text[begin : begin + 4000])
                file.flush()
                time.sleep(self._random.random() * 0.2)

    def by_truncating_and_waiting(self, text: str) -> None:
        self._source.write_text("")
        time.sleep(self._random.random() * 2)
        self._source.write_text(text)

    def by_deleting(self, text: str) -> None:
        self._source.unlink()
        time.sleep(self._random.random() * 2)
        self._source.write_text(text)


class _Saver(_Writer):
    def by_renaming(self, text: str) -> None:
        new = self._source.with_suffix(".new")
        new.write_text(text)
        new.rename(self._source)

    def by_replacing_the_folder(self, text: str) -> None:
        folder = self._source.parent
        new, old = folder.with_name("new"), folder.with_name("old")
        shutil.copytree(folder, new)
        (new / self._source.name).write_text(text)
        folder.rename(old)
        new.rename(folder)
        shutil.rmtree(old)

    def by_changing_the_mesh(self, text: str) -> None:
        _write_mesh(self._source.parent / "part.stl", self._random)


class _Hand:
    """Writes comments into generated files; `tags` are those that have to be there at the end."""

    def __init__(self, project: Path, random: Random, soak: Soak) -> None:
        self._project, self._random, self._soak = project, random, soak
        self._count = 0
        self.tags: set[str] = set()

    def step(self) -> None:
        """Edit a file, or something else, then wait a little."""
        files = sorted((self._project / "modelica").rglob("*.mo"))
        dice = self._random.random()
        if dice < 0.05:
            self._soak.counts["build by hand"] += 1
            _urdfsync(self._project, "build", "-q")
        elif files and dice < 0.1:
            self._delete(self._random.choice(files))
        elif files:
            self._comment(self._random.choice(files))
        time.sleep(self._random.choice([0.1, 0.5, 1.0, 3.0]))

    def _comment(self, path: Path) -> None:
        try:
            lines = path.read_text().splitlines(keepends=True)
        except FileNotFoundError:
            return
        self._count += 1
        tag = f"// mine {self._count}"
        lines.insert(self._random.randrange(1, len(lines)), f"  {tag}\n")
        if not path.parent.is_dir():
            return
        path.write_text("".join(lines))
        self.tags.add(tag)
        self._soak.counts["comments"] += 1

    def _delete(self, path: Path) -> None:
        """Delete a file that has no comment."""
        try:
            if not TAG.search(path.read_text()):
                path.unlink()
                self._soak.counts["deletions"] += 1
        except FileNotFoundError:
            return


def variant(random: Random) -> str:
    """The six-axis arm with other numbers, and with some links more."""
    text = ROBOT.read_text()
    root = text.split('<link name="', 1)[1].split('"', 1)[0]
    masses = iter(re.split(r'(?<=<mass value=")[^"]*', text))
    text = next(masses) + "".join(f"{random.randrange(1, 200) / 8:g}{rest}" for rest in masses)
    extra = [_EXTRA.format(f"extra{n}", random.randrange(1, 9), root) for n in range(4) if random.random() < 0.5]
    part = '<link name="part"><visual><geometry><mesh filename="part.stl"/></geometry></visual></link>'
    joint = f'<joint name="part_joint" type="fixed"><parent link="{root}"/><child link="part"/></joint>'
    return text.replace("</robot>", f"{part}{joint}{''.join(extra)}</robot>")


def _write_mesh(path: Path, random: Random) -> None:
    x = random.randrange(1, 1000)
    vertices = f"vertex 0 0 0\nvertex {x} 0 0\nvertex 0 1 0\n"
    path.write_text(f"solid a\nfacet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid\n")


def _project(folder: Path, random: Random) -> Path:
    for place, name in (("cad", "arm"), ("export", "leg")):
        (folder / place).mkdir(parents=True)
        (folder / place / f"{name}.urdf").write_text(variant(random))
        _write_mesh(folder / place / "part.stl", random)
    text = CONFIG.format("arm", "cad", "Arm") + CONFIG.format("leg", "export", "Leg")
    (folder / "urdfsync.toml").write_text(text)
    return folder


def _compare(project: Path, fresh: Path, tags: set[str]) -> Iterator[str]:
    """What is not as it should be."""
    done = _urdfsync(project, "build", "--check", "--json")
    document = json.loads(done.stdout)
    if done.returncode not in (0, 3):
        yield f"out of step: {[robot['summary'] for robot in document['robots']]} {document['diagnostics']}"
    held = {robot["name"] for robot in document["robots"] if robot["conflicts"]}
    for robot in document["robots"]:
        yield from (
            f"not resolved: {c['path']}: {c['reason']}" for c in robot["conflicts"] if not _is_edited(project, c)
        )
    everything = "".join(path.read_text() for path in (project / "modelica").rglob("*.mo*"))  # `.mo.saved`, too
    lost = tags - set(TAG.findall(everything))
    yield from (f"lost: {tag}" for tag in sorted(lost))
    shutil.copytree(project, fresh, ignore=shutil.ignore_patterns("modelica", ".urdfsync"))
    _urdfsync(fresh, "build", "-q")
    for robot in ROBOTS:
        if robot not in held:  # a conflict keeps the rest of its robot waiting
            yield from _differences(
                project / f"modelica/{robot.capitalize()}", fresh / f"modelica/{robot.capitalize()}"
            )


def _is_edited(project: Path, conflict: dict[str, str]) -> bool:
    path = project / (conflict["origin"] or conflict["path"])
    return path.is_file() and TAG.search(path.read_text()) is not None


def _is_kept(path: Path) -> bool:
    """Whether a class is edited, or the record of an edited model."""
    model = path.with_name(path.name.replace("Parameters.mo", ".mo"))
    return any(file.is_file() and TAG.search(file.read_text()) is not None for file in (path, model))


def _differences(package: Path, fresh: Path) -> Iterator[str]:
    for path in sorted(fresh.rglob("*")):
        mine = package / path.relative_to(fresh)
        if path.is_dir():
            continue
        if not mine.is_file():
            yield f"missing: {mine}"
        elif path.suffix == ".mo":
            text = "".join(line for line in mine.read_text().splitlines(keepends=True) if not TAG.search(line))
            if text != path.read_text():
                yield f"stale: {mine}"
        elif mine.read_bytes() != path.read_bytes() and path.name != "package.order":
            yield f"stale: {mine}"
    for path in sorted(package.rglob("*.mo")):
        ours = path.name != "package.mo" and not _is_kept(path)
        if ours and not (fresh / path.relative_to(package)).is_file():
            yield f"left over: {path}"


def _urdfsync(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY)}
    command = [sys.executable, "-m", "urdfsync", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def main() -> int:
    """Run, and print what happened."""
    minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 3.0
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else time.time_ns() % 100_000
    print(f"seed {seed}", flush=True)  # noqa: T201
    with tempfile.TemporaryDirectory() as folder:
        soak = run(Path(folder), 60 * minutes, seed)
    for name, count in sorted(soak.counts.items()):
        print(f"{count:6} {name}")  # noqa: T201
    print("\n".join(soak.problems) or "nothing lost, nothing stale")  # noqa: T201
    return 1 if soak.problems else 0


if __name__ == "__main__":
    sys.exit(main())
