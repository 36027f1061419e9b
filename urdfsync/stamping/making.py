"""Makes stamps, after a command has found that there is nothing to do; nothing is stamped that can't be trusted."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from urdfsync import streams
from urdfsync.dependencies import Dependencies, Stat, file_type, record_dependencies, stat_of
from urdfsync.files import TEMPORARY
from urdfsync.stamping import stamp, trust
from urdfsync.stamping.stamp import Facts, Stamp

_MOST_CLAIMS = 16
_LONGEST = 100_000
"""Characters of an answer."""
_Paths = dict[str, Facts]


def carry_out(arguments: list[str], run: Callable[[streams.Said | None], int]) -> int:
    """Run a command, which takes down what it says, and stamp it if it can be said again. Returns its exit code."""
    if not trust.HAS_CHANGE_TIMES or not arguments or arguments[0] not in stamp.COMMANDS:
        return run(None)
    said: streams.Said = []
    begin = stamp.now()
    with record_dependencies() as looks:
        question, file = _question(arguments)
        code = run(said)
    if code == 0 and file is not None and looks.complete and sum(len(text) for _, text in said) <= _LONGEST:
        keep(file, {question: [text for pair in said if pair[1] for text in pair]}, looks, begin)
    return code


def keep(file: str, claims: dict[str, list[str]], looks: Dependencies, begin: tuple[int, int]) -> None:
    """Stamp what follows from looks since `begin` for a configuration; what can't be stamped is not."""
    if not looks.complete or not trust.HAS_CHANGE_TIMES:
        return
    with contextlib.suppress(OSError, ValueError):
        made = Stamp(stamp.program(), *_paths(looks), claims)
        if str(Path(file)) in made.contents[True]:
            made.contents[True].update(_modules())
            path = stamp.place(file)
            _write(_with_older(made, path), looks, path, begin)


def _question(arguments: list[str]) -> tuple[str, str | None]:
    """The command as the stamp will be asked for it."""
    try:
        file = stamp.configuration(arguments)
        return (stamp.question(arguments, file), file) if file and sys.stdout and sys.stderr else ("", None)
    except OSError:
        return "", None


def _paths(looks: Dependencies) -> tuple[tuple[_Paths, _Paths], tuple[_Paths, _Paths]]:
    """Contents and kinds with absolute paths; kinds that follow from contents are left out."""
    folder = os.getcwd()  # noqa: PTH109
    own, targets = (_absolute(group, folder) for group in looks.stats)
    plain = {path for path, facts in own.items() if not _is_link(facts)}
    of_links, of_targets = (_absolute({path: (kind,) for path, kind in group.items()}, folder) for group in looks.types)
    of_links = {path: kind for path, kind in of_links.items() if path not in own}
    of_targets = {path: kind for path, kind in of_targets.items() if path not in targets and path not in plain}
    return (own, targets), (of_links, of_targets)


def _absolute(group: Mapping[str, Facts], folder: str) -> _Paths:
    return {os.path.join(folder, path): facts for path, facts in group.items()}  # noqa: PTH118 - there are thousands


def _is_link(facts: Sequence[int]) -> bool:
    return facts[0] & 0o170000 == 0o120000


def _modules() -> Iterator[tuple[str, Stat]]:
    """The program itself, with all that it loaded to come to its conclusions."""
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file and name.partition(".")[0] not in sys.stdlib_module_names:
            with contextlib.suppress(FileNotFoundError, NotADirectoryError):  # in an archive: its version has to do
                yield os.path.abspath(file), stat_of(os.stat(file))  # noqa: PTH100, PTH116


def _with_older(made: Stamp, path: str) -> Stamp:
    """A stamp with what the one that is there says as well, if that still stands."""
    reading = stamp.read(path)
    older = _unpacked(reading) if reading and len(reading.claims) < _MOST_CLAIMS else None
    if older is None:
        return made
    for old, new in zip((*older.contents, *older.kinds), (*made.contents, *made.kinds), strict=True):
        if any(new.get(path, facts) != facts for path, facts in old.items()):
            return made  # it changes at this moment
        old.update(new)
    older.claims.update(made.claims)
    return older


def _unpacked(reading: stamp.Reading) -> Stamp | None:
    """A stamp with its facts, which are those of now; None if it does not stand."""
    try:
        own: _Paths = {path: stat_of(os.lstat(path)) for path in reading.own}
        targets: _Paths = {path: stat_of(os.stat(path)) for path in reading.targets}  # noqa: PTH116
        links, kinds = map(_kinds, reading.kinds, (False, True))
    except (OSError, ValueError):
        return None
    found = Stamp(reading.program, (own, targets), (links, kinds), reading.claims)
    return found if found.numbers() == reading.numbers else None


def _kinds(paths: Iterable[str], follow: bool) -> _Paths:
    return {path: (file_type(path, follow=follow),) for path in paths}


def _write(made: Stamp, looks: Dependencies, path: str, begin: tuple[int, int]) -> None:
    """Write a stamp unless something that it rests on is too new to be trusted. Raises OSError or ValueError."""
    folder, name = os.path.split(path)
    temporary = os.path.join(folder, f".{name}{TEMPORARY}")  # noqa: PTH118
    with contextlib.suppress(FileNotFoundError):
        os.unlink(temporary)  # noqa: PTH108 - of a process that was killed, or that has none then
    with contextlib.ExitStack() as stack:
        file = stack.enter_context(open(temporary, "xb"))  # noqa: PTH123
        stack.callback(_remove, temporary)
        clock = trust.Clock.of(file.fileno())
        seen = (facts for group in looks.stats for facts in group.values())
        modules = (facts for _, facts in _modules())
        passed, running = stamp.passed(begin), stamp.since_begin()
        if not all(clock.trusts(facts, passed) for facts in seen):
            return
        if not all(clock.trusts(facts, running) for facts in modules):
            return
        now = clock.made
        file.write(made.dumps(now.st_ino, now.st_mtime_ns))
        file.flush()
        os.utime(file.fileno(), ns=(now.st_mtime_ns, now.st_mtime_ns))
        file.close()
        os.replace(temporary, path)  # noqa: PTH105


def _remove(temporary: str) -> None:
    with contextlib.suppress(OSError):
        os.unlink(temporary)  # noqa: PTH108
