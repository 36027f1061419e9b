"""The daemon under random edits by two writers and a hand editor; at the end nothing may be lost or stale.

One writer exports as CAD programs do, in place and in pieces; the other saves as editors do, or replaces the whole
folder, and changes the mesh. The hand editor writes comments into generated files, deletes some, and builds by hand.
At the end each package has to equal a fresh build of its source but for the comments, and no comment may be missing.
This takes half a minute, or `$URDFSYNC_SOAK` seconds.
"""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from random import Random

import pytest
from support.daemon import REPOSITORY, Watch

from urdfsync.modelica.stamp import split

ROBOT = REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm" / "six_axis_arm.urdf"
ROBOTS = {"arm": "cad", "leg": "export"}
"""The folders of their sources."""
CONFIG = '[robots.{0}]\nsource = "{1}/{0}.urdf"\npackage = "{2}"\non_conflict = "merge"\n'
TAG = re.compile(r"// mine \d+")
SECONDS = float(os.environ.get("URDFSYNC_SOAK", "30"))
_QUIET = 5.0
"""Seconds that all is left alone at the end."""
_EXTRA = (
    '<link name="{0}"><inertial><mass value="{1}"/>'
    '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
    '<joint name="{0}_joint" type="fixed"><parent link="{2}"/><child link="{0}"/></joint>'
)

Way = Callable[[Path, str, Random], object]
"""A way to write the text of a source."""


@dataclasses.dataclass
class Soak:
    """What happened, and what is wrong."""

    counts: Counter[str] = dataclasses.field(default_factory=Counter)
    problems: list[str] = dataclasses.field(default_factory=list)
    tags: set[str] = dataclasses.field(default_factory=set)
    """The comments that have to be there at the end."""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="folders that are watched can't be replaced there")
@pytest.mark.large  # the walks show the same, without a daemon
def test_nothing_is_lost_and_nothing_stale(tmp_path: Path) -> None:
    soak, project = Soak(), tmp_path / "project"
    for robot, place in ROBOTS.items():
        (project / place).mkdir(parents=True)
        (project / place / f"{robot}.urdf").write_text(variant(Random(1)))
        _write_mesh(project / place / "part.stl", "", Random(1))
    tables = (CONFIG.format(robot, place, robot.capitalize()) for robot, place in ROBOTS.items())
    (project / "urdfsync.toml").write_text("".join(tables))
    with Watch(project, "--rescan", "5") as watch:
        watch.rest(robots=len(ROBOTS))
        steps = (
            lambda random: _write(project / "cad/arm.urdf", EXPORTS, random, soak),
            lambda random: _write(project / "export/leg.urdf", SAVES, random, soak),
            lambda random: _edit(project, random, soak),
        )
        _all_at_once(steps, SECONDS, soak)
        time.sleep(_QUIET)
        watch.rest()
        if watch.process.poll() is not None or watch.stop() != 0 or watch.errors:
            soak.problems.append(f"the daemon ended badly:\n{watch.said}")
        soak.counts.update(f"event {event['event']}" for event in watch.events)
        soak.problems += [
            f"failed: {event['result']['diagnostics']}" for event in watch.events if event["event"] == "failed"
        ]
    soak.problems += _compare(project, tmp_path / "fresh", soak.tags)
    assert soak.problems == []
    assert soak.counts["event built"] >= SECONDS / 20, soak.counts
    assert soak.counts["comments"] >= SECONDS / 20, soak.counts


def _all_at_once(steps: Sequence[Callable[[Random], None]], seconds: float, soak: Soak) -> None:
    end = time.monotonic() + seconds

    def repeat(step: Callable[[Random], None], random: Random) -> None:
        try:
            while time.monotonic() < end:
                step(random)
        except Exception as error:  # noqa: BLE001 - of a thread, and told in the end
            soak.problems.append(repr(error))

    threads = [threading.Thread(target=repeat, args=[step, Random(seed)]) for seed, step in enumerate(steps, 2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


# Writers


def _write(source: Path, ways: Sequence[Way], random: Random, soak: Soak) -> None:
    """Write a variant in some way, then wait a little."""
    way = random.choice(ways)
    soak.counts[way.__name__.strip("_")] += 1
    way(source, variant(random), random)
    time.sleep(random.choice([0.05, 0.4, 0.8, 1.5, 2.5]))


def _write_at_once(source: Path, text: str, random: Random) -> None:
    source.write_text(text)


def _write_in_pieces(source: Path, text: str, random: Random) -> None:
    with source.open("w") as file:
        for begin in range(0, len(text), 4000):
            file.write(text[begin : begin + 4000])
            file.flush()
            time.sleep(random.random() * 0.2)


def _truncate_and_write(source: Path, text: str, random: Random) -> None:
    source.write_text("")
    time.sleep(random.random() * 2)
    source.write_text(text)


def _delete_and_write(source: Path, text: str, random: Random) -> None:
    source.unlink()
    time.sleep(random.random() * 2)
    source.write_text(text)


def _rename(source: Path, text: str, random: Random) -> None:
    source.with_suffix(".new").write_text(text)
    source.with_suffix(".new").rename(source)


def _replace_the_folder(source: Path, text: str, random: Random) -> None:
    folder = source.parent
    new, old = folder.with_name("new"), folder.with_name("old")
    shutil.copytree(folder, new)
    (new / source.name).write_text(text)
    folder.rename(old)
    new.rename(folder)
    shutil.rmtree(old)


def _write_mesh(source: Path, text: str, random: Random) -> None:
    vertices = f"vertex 0 0 0\nvertex {random.randrange(1, 1000)} 0 0\nvertex 0 1 0\n"
    mesh = f"solid a\nfacet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid\n"
    source.with_name("part.stl").write_text(mesh)


EXPORTS: Sequence[Way] = (_write_at_once, _write_in_pieces, _truncate_and_write, _delete_and_write)
SAVES: Sequence[Way] = (_rename, _replace_the_folder, _write_mesh)


def variant(random: Random) -> str:
    """The six-axis arm with other numbers, and with some links more."""
    text = ROBOT.read_text()
    root = text.split('<link name="', 1)[1].split('"', 1)[0]
    text = re.sub(r'(?<=<mass value=")[^"]*', lambda _: f"{random.randrange(1, 200) / 8:g}", text)
    extra = [_EXTRA.format(f"extra{n}", random.randrange(1, 9), root) for n in range(4) if random.random() < 0.5]
    part = '<link name="part"><visual><geometry><mesh filename="part.stl"/></geometry></visual></link>'
    joint = f'<joint name="part_joint" type="fixed"><parent link="{root}"/><child link="part"/></joint>'
    return text.replace("</robot>", f"{part}{joint}{''.join(extra)}</robot>")


# The hand editor


def _edit(project: Path, random: Random, soak: Soak) -> None:
    """Write a comment into a generated file, delete one that has none, or build; then wait a little."""
    files, dice = sorted((project / "modelica").rglob("*.mo")), random.random()
    if dice < 0.05:
        soak.counts["build by hand"] += 1
        _urdfsync(project, "build", "-q")
    elif files:
        with contextlib.suppress(FileNotFoundError):  # the daemon was quicker
            path = random.choice(files)
            lines, tag = path.read_text().splitlines(keepends=True), f"// mine {soak.counts['comments'] + 1}"
            if dice < 0.1 and not _is_edited(path):
                path.unlink()
                soak.counts["deletions"] += 1
            elif dice >= 0.1:
                lines.insert(random.randrange(1, len(lines)), f"  {tag}\n")
                path.write_text("".join(lines))
                soak.tags.add(tag)
                soak.counts["comments"] += 1
    time.sleep(random.choice([0.1, 0.5, 1.0, 3.0]))


# The end


def _compare(project: Path, fresh: Path, tags: set[str]) -> Iterator[str]:
    """What is not as it should be."""
    done = _urdfsync(project, "build", "--check", "--format=json")
    document = json.loads(done.stdout)
    if done.returncode not in (0, 3):
        yield f"out of step: {[robot['summary'] for robot in document['results']]} {document['diagnostics']}"
    everything = "".join(path.read_text() for path in (project / "modelica").rglob("*.mo*"))  # `.mo.saved`, too
    yield from (f"lost: {tag}" for tag in sorted(tags - set(TAG.findall(everything))))
    shutil.copytree(project, fresh, ignore=shutil.ignore_patterns("modelica", ".urdfsync"))
    _urdfsync(fresh, "build", "-q")
    for robot in document["results"]:
        disputed = [one["action"] for one in robot["conflicts"]]
        edited = (_is_edited(project / (one["origin"] or one["path"])) for one in disputed)
        yield from (f"not resolved: {one['path']}" for one, is_edited in zip(disputed, edited, strict=True)
                    if not is_edited)  # fmt: skip
        if not disputed:  # which keep the rest of their robot waiting
            place = f"modelica/{robot['robot'].capitalize()}"
            yield from _differences(project / place, fresh / place)


def _is_edited(path: Path) -> bool:
    return path.is_file() and TAG.search(path.read_text()) is not None


def _differences(package: Path, fresh: Path) -> Iterator[str]:
    for path in sorted(path for path in fresh.rglob("*") if path.is_file()):
        mine = package / path.relative_to(fresh)
        if not mine.is_file():
            yield f"missing: {mine}"
        elif path.suffix == ".mo":
            text = "".join(line for line in mine.read_text().splitlines(keepends=True) if not TAG.search(line))
            # a part that has come back has another id
            yield from [f"stale: {mine}"] if split(text)[0] != split(path.read_text())[0] else []
        elif mine.read_bytes() != path.read_bytes() and path.name != "package.order":
            yield f"stale: {mine}"
    for path in sorted(package.rglob("*.mo")):
        model = path.with_name(path.name.replace("Parameters.mo", ".mo"))  # keeps its record
        is_ours = path.name != "package.mo" and not _is_edited(path) and not _is_edited(model)
        if is_ours and not (fresh / path.relative_to(package)).is_file():
            yield f"left over: {path}"


def _urdfsync(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY)}
    command = [sys.executable, "-m", "urdfsync", *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
