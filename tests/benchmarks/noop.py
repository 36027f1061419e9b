"""A command that has nothing to do, beside an empty console script, other build tools and `git status`.

Two workspaces: one robot with about 400 outputs, and 100 robots with about 8,000 together. Build tools that are there
get the same outputs, each made from its robot's source. The empty console script is installed beside `urdfsync`, in
an environment of its own that sees what this one has.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from benchmarks.measuring import Cost, Quantity, measure, run
from benchmarks.peers import peers
from benchmarks.robots import write_workspace
from benchmarks.study import Row, Study
from benchmarks.tools import Tools

EMPTY, GIT = "empty console script", "git status"
ONE, MANY = "400 outputs", "8,000 outputs"

ROWS = (
    *(Row(f"{command}, {ONE}", EMPTY, 1.3) for command in ("build", "build --check", "status")),
    Row(f"hook, {ONE}", EMPTY),
    Row(f"build, {ONE}", f"doit, {ONE}", 0.2),
    Row(f"build, {ONE}", f"dvc status, {ONE}", 0.05),
    Row(f"build, {ONE}", f"ninja, {ONE}"),
    Row(f"build, {MANY}", EMPTY, 3.5),
    Row(f"build, {MANY}", f"{GIT}, {MANY}", 3.0),
    *(Row(f"build, {outputs}", EMPTY, None, Quantity.CPU) for outputs in (ONE, MANY)),
    Row(f"build without a stamp, {ONE}", EMPTY),
    Row(f"build without a stamp, {MANY}", EMPTY),
)
_COMMANDS = (["build"], ["build", "--check"], ["status"])
_IN_STEP = "in step"
_PATIENCE = 60.0
"""Seconds to wait for a stamp."""


def studies(tools: Tools) -> Iterator[Study]:
    """What is measured."""
    found: dict[str, Callable[[], Cost]] = {EMPTY: tools.empty}
    for label, robots, links in ((ONE, 1, 97), (MANY, 100, 17)):
        place = _workspace(tools, f"{robots}", robots, links)
        for command in _COMMANDS:
            found[f"{' '.join(command)}, {label}"] = _measurement(tools.urdfsync(*command), place, _IN_STEP)
        found[f"hook, {label}"] = _measurement(tools.hook(), place, "")
        found[f"build without a stamp, {label}"] = _unstamped(tools.urdfsync("build"), place)
        if tools.program("git"):
            found[f"{GIT}, {label}"] = _measurement(["git", "status"], place, "working tree clean")
    found |= {f"{peer.name}, {ONE}": peer for peer in peers(tools, tools.folder / "1")}
    yield Study("nothing to do", found, ROWS)


def _measurement(command: Sequence[str], folder: Path, said: str) -> Callable[[], Cost]:
    return lambda: measure(command, folder, said)


def _unstamped(command: Sequence[str], folder: Path) -> Callable[[], Cost]:
    """The full decision; the stamp is brought back afterwards, and is as good as before."""
    stamp = folder / ".urdfsync/stamp"

    def measurement() -> Cost:
        stamp.rename(stamp.with_name("kept"))
        cost = measure(command, folder, _IN_STEP)
        stamp.with_name("kept").replace(stamp)
        return cost

    return measurement


def _workspace(tools: Tools, name: str, robots: int, links: int) -> Path:
    """Robots that are built, committed and stamped."""
    folder = write_workspace(tools.folder / name, robots, links)
    run(tools.urdfsync("build", "--quiet"), folder)
    if tools.program("git"):
        tools.commit(folder)
    end = time.monotonic() + _PATIENCE
    stamp, size = folder / ".urdfsync/stamp", -1
    while size != (size := stamp.stat().st_size if stamp.exists() else -1) or size < 0:
        if time.monotonic() > end:
            raise TimeoutError(f"no stamp in {folder}")
        for command in _COMMANDS:
            run(tools.urdfsync(*command), folder)
        run(tools.hook(), folder)
        time.sleep(0.1)
    return folder
