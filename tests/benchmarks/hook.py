"""The hooks' entry when nothing changed, whole processes, beside Python doing nothing.

Repositories: one robot, ten robots, and one robot whose meshes have 200 MB; each committed, in step. `urdfsync build
--check` stands beside them, and a file changed that does not matter, and one that does, so that what is staged is
judged in a mirror.
"""

from __future__ import annotations

import random
import shutil
import struct
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from support.corpus import REPOSITORY

from benchmarks.measuring import Cost, measure, run
from benchmarks.study import Row, Study
from benchmarks.tools import NOTHING, Tools

ARM = REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm" / "six_axis_arm.urdf"
MESH = 10 * 1024 * 1024
"""Bytes of each of the large meshes."""
_TICK = 0.2
"""Seconds after which a file is not taken for one that is just being written."""


def studies(tools: Tools) -> Iterator[Study]:
    """What is measured."""
    if not tools.program("git"):
        return
    found: dict[str, Callable[[], Cost]] = {NOTHING: tools.nothing}
    places = {
        "1 robot": _repository(tools, "one", 1),
        "10 robots": _repository(tools, "ten", 10),
        "200 MB of meshes": _repository(tools, "large", 1, meshes=20),
    }
    for label, place in places.items():
        found[f"{label}: build --check"] = _check(tools, place)
        found[f"{label}: hook"] = _hook(tools, place)
        found[f"{label}: hook, another file changed"] = _hook(tools, place, "notes.txt")
        found[f"{label}: hook, a source changed"] = _hook(tools, place, "arm0.urdf")
    yield Study("hooks", found, [Row(label, NOTHING) for label in found if label != NOTHING])


def _check(tools: Tools, place: Path) -> Callable[[], Cost]:
    return lambda: measure(tools.urdfsync("build", "--check"), place, "in step")


def _hook(tools: Tools, place: Path, name: str | None = None) -> Callable[[], Cost]:
    """The hook, while a file of this name has a change that is not staged."""

    def measurement() -> Cost:
        if name is None:
            return measure(tools.hook(), place)
        path = place / name
        content = path.read_bytes()
        path.write_bytes(content.replace(b'mass value="', b'mass value="1') + b"\n")
        try:
            return measure(tools.hook(), place)
        finally:
            path.write_bytes(content)
            _renew(tools, place)

    return measurement


def _renew(tools: Tools, place: Path) -> None:
    """Let git and the stamp know files that were just written, so that the next measurement does not pay for that."""
    run(["git", "update-index", "-q", "--refresh"], place)
    time.sleep(_TICK)
    for command in (tools.urdfsync("build", "--check"), tools.hook()):
        run(command, place)


def _repository(tools: Tools, name: str, robots: int, meshes: int = 0) -> Path:
    """A repository of copies of the arm, built and committed; `meshes` is the number of large ones."""
    folder = tools.folder / name
    shutil.copytree(ARM.parent, folder)
    text = ARM.read_text(encoding="utf-8")
    for number in range(meshes):
        (folder / f"large{number}.stl").write_bytes(bytes(80) + _triangles(number))
        part = f"large{number}"
        visual = f'<visual><geometry><mesh filename="{part}.stl"/></geometry></visual>'
        ends = f'<parent link="base_link"/><child link="{part}"/>'
        link, joint = f'<link name="{part}">{visual}</link>', f'<joint name="to_{part}" type="fixed">{ends}</joint>'
        text = text.replace("</robot>", f"{link}{joint}</robot>")
    configuration = []
    for number in range(robots):
        (folder / f"arm{number}.urdf").write_text(text, encoding="utf-8")
        configuration.append(f'[robots.arm{number}]\nsource = "arm{number}.urdf"\npackage = "Arm{number}"\n')
    (folder / "urdfsync.toml").write_text("".join(configuration), encoding="utf-8")
    (folder / "notes.txt").write_text("notes\n", encoding="utf-8")
    run(tools.urdfsync("build", "--quiet"), folder)
    tools.commit(folder)
    _renew(tools, folder)
    return folder


def _triangles(seed: int) -> bytes:
    """A binary STL after its header: random triangles."""
    count, numbers = MESH // 50, random.Random(seed)
    triangles = (struct.pack("<12fH", *(numbers.random() for _ in range(12)), 0) for _ in range(count))
    return count.to_bytes(4, "little") + b"".join(triangles)
