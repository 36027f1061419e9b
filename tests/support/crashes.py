"""Crashes, errors and the user's saves at each file operation of a build."""

from __future__ import annotations

import contextlib
import dataclasses
import gc
import itertools
import os
import shutil
import signal
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath
from random import Random
from typing import Any

from support import edits
from support.choices import options
from support.urdfs import joint, limit, link, robot
from urdfsync.engine.build import build
from urdfsync.engine.result import Result
from urdfsync.project import config
from urdfsync.project.state import file_operations
from urdfsync.project.state.store import Store

CHANGES = ("exchange", "place", "replace")
"""Operations on targets."""
NAMES = (*CHANGES, "make_folder", "remove_folder", "write", "remove", "sync")
CONFIGURATION = '[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\n'
ALL = "URDFSYNC_CRASHES"
"""Environment variable that chooses all operations, whatever its value."""


@dataclasses.dataclass(frozen=True)
class Operation:
    """The call of an operation: its number among all operations, its name and its paths."""

    number: int
    name: str
    paths: tuple[Path, ...]

    @property
    def kind(self) -> tuple[str, ...]:
        """A kind, which operations share if only their files differ."""
        places = ("base", "robots") if self.paths[-1:] else ()
        return (self.name, *(next((p for p in places if p in path.parts), path.suffix) for path in self.paths))


Hook = Callable[[Operation], None]


@contextlib.contextmanager
def before_each(hook: Hook) -> Iterator[None]:
    """Call `hook` before each operation."""
    count = 0
    real = {name: getattr(file_operations, name) for name in NAMES}

    def wrapped(name: str) -> Callable[..., Any]:
        def call(*arguments: Any) -> Any:
            nonlocal count
            count += 1
            hook(Operation(count, name, tuple(Path(path) for path in arguments if isinstance(path, str | Path))))
            return real[name](*arguments)

        return call

    try:
        for name in NAMES:
            setattr(file_operations, name, wrapped(name))
        yield
    finally:
        for name, function in real.items():
            setattr(file_operations, name, function)


def run(project: Path, **request: Any) -> Result:
    """Build the only robot of a project, to any folder."""
    loaded = config.load(project / "urdfsync.toml")
    (result,) = build(loaded, loaded.robots, options(loaded, trusted=True, **request))
    return result


def operations(project: Path, names: Sequence[str]) -> list[Operation]:
    """Build, and return the first or the last operation of each kind, in turns, with one of these names.

    If the environment says so, return all operations of these names. A name without an operation fails the test.
    """
    found: list[Operation] = []
    with before_each(found.append):
        assert not run(project).failed
    found = [operation for operation in found if operation.name in names]
    assert found
    assert {operation.name for operation in found} == set(names)
    if os.environ.get(ALL):
        return found
    kinds: dict[tuple[str, ...], list[Operation]] = {}
    for operation in found:
        kinds.setdefault(operation.kind, []).append(operation)
    chosen = (same[-(number % 2)] for number, same in enumerate(kinds.values()))
    return sorted(chosen, key=lambda operation: operation.number)


def kill(project: Path, number: int, half: bool = False, earlier: Hook = lambda operation: None) -> None:
    """Build in a process that kills itself before an operation, or with `half` of the content written.

    `earlier` is called before that operation and each one before it. A build without this operation fails the test.
    """

    def hook(operation: Operation) -> None:
        earlier(operation)
        if operation.number == number:
            if half and operation.name == "write":
                with operation.paths[0].open("ab") as file:  # only `append` finds a file
                    file.write(b'{"robot": "cut sh')
            os.kill(os.getpid(), signal.SIGKILL)

    _, status = os.waitpid(forked(project, hook), 0)
    assert os.WIFSIGNALED(status)
    assert os.WTERMSIG(status) == signal.SIGKILL


def forked(project: Path, hook: Hook, work: Callable[[Path], int] = lambda project: run(project).failed) -> int:
    """Build, or do other work, in another process; return the process id. The exit code comes from the work."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # the test runner's threads do not matter to the child
        child = os.fork()
    if child == 0:
        gc.disable()  # a garbage collection would copy all memory of the tests
        code = 1
        try:
            with before_each(hook):
                code = work(project)
        finally:
            os._exit(code)
    return child


def edited_at_random(project: Path, random: Random) -> None:
    """Make a project with a built robot, an edit by hand, and then a changed source."""
    project.mkdir(parents=True)
    (project / "urdfsync.toml").write_text(CONFIGURATION)
    _export(project, 0, [])
    hand = edits.Hand(random)
    for count in (random.randint(1, 5), random.randint(0, 3)):
        run(project)
        for _ in range(count):
            hand.edit(project / "modelica/Bot")
    _export(project, random.random(), random.sample(["b1", "b2", "b3", "b4", "b5"], random.randint(1, 3)))


def moved_at_random(project: Path, random: Random) -> None:
    """Make a project with a built robot and edits, of which an export then renames, exchanges or shifts the names.

    Sometimes its package has another name, too, and merges are allowed.
    """
    project.mkdir(parents=True)
    merges = 'on_conflict = "merge"\n' if random.random() < 0.6 else ""
    (project / "urdfsync.toml").write_text(CONFIGURATION + merges)
    names = ["a1", "a2", "a3", "a4"]
    export_chain(project, names)
    run(project)
    hand = edits.Hand(random)
    for _ in range(random.randint(1, 6)):
        hand.edit(project / "modelica/Bot")
    if random.random() < 0.5:
        run(project)
    new = random.choice(
        (random.sample(names, 4), ["a2", "a1", "a3", "a4"], ["a2", "a3", "a4", "a5"], ["a1", "b", *names[2:]])
    )
    export_chain(project, new, random.choice((0, random.random())))
    if random.random() < 0.3:
        (project / "urdfsync.toml").write_text(
            CONFIGURATION.replace('"Bot"', '"Plant.Bat"') + merges + "create_parents = true\n"
        )


def export_chain(project: Path, names: Sequence[str], mass: float = 0) -> None:
    """A chain of links without two alike joints: the last link has so much more mass."""
    masses = [1.0 + 0.7 * number for number in range(len(names) + 1)]
    elements = [link(*one) for one in zip(["base", *names], [*masses[:-1], masses[-1] + mass], strict=True)]
    axes, ends = ("1 0 0", "0 1 0", "0 0 1", "0 0.6 0.8"), itertools.pairwise(["base", *names])
    elements += [
        joint(f"j{number}", "revolute", *pair, axis=axes[number % 4], inside=[limit()])
        for number, pair in enumerate(ends)
    ]
    (project / "bot.urdf").write_text(robot(*elements))


def _export(project: Path, mass: float, renamed: Sequence[str]) -> None:
    """A chain of links, some with another name and a new sibling."""
    names = ["base", *(f"{name}x" if name in renamed else name for name in ("b1", "b2", "b3", "b4", "b5"))]
    elements = [link(name, 1.0 + mass * number) for number, name in enumerate(names)]
    ends = itertools.pairwise(names)
    elements += [joint(f"j{n}", "revolute", *pair, axis="0 0 1", inside=[limit()]) for n, pair in enumerate(ends)]
    for name in renamed[1:]:
        elements += [link(f"{name}new", mass), joint(f"{name}j", "fixed", "base", f"{name}new")]
    (project / "bot.urdf").write_text(robot(*elements))


def copy(project: Path, to: Path) -> Path:
    """Copy the project to an empty place."""
    if to.exists():
        shutil.rmtree(to)
    shutil.copytree(project, to)
    return to


def contents(project: Path) -> Mapping[str, bytes | None]:
    """All files and folders of a project except the lock; folders have no content.

    Only bases that recorded files need count: an earlier build may have left others, and copies of replaced files.
    """
    found = {path.relative_to(project).as_posix(): path for path in project.rglob("*")}
    left_out = {".urdfsync/lock", ".urdfsync/bases", ".urdfsync/aside", ".urdfsync/notes", ".urdfsync/deps"}
    names = [name for name in found if left_out.isdisjoint((name, *map(str, PurePosixPath(name).parents)))]
    contents = {name: found[name].read_bytes() if found[name].is_file() else None for name in sorted(names)}
    return contents | {f".urdfsync/bases/{robot}": _needed(project, robot) for robot in Store(project).names()}


def _needed(project: Path, robot: str) -> bytes:
    """The bases that a record needs, by their hashes."""
    store = Store(project)
    needed = {base for record in store.load(robot)[0] for base in record.files.values()}
    return repr([(digest, store.base(robot, digest)) for digest in sorted(needed)]).encode()
