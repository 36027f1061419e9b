"""The stamp: what commands looked at, and what they said, so that it can be said again while all of that is the same.

It is read before anything else is loaded, so this module imports only what Python has loaded at its start, or what
takes no time. A stamp that can't be read, or that is not from this very place, is none. Wrong or lost, it costs time.
"""

import os
import sys
import time
import zlib

from urdfsync import __version__, streams

COMMANDS = ("build", "status")
"""What can be said again."""
CONFIGURATION = "urdfsync.toml"

_BEGUN = time.monotonic_ns(), time.time_ns()
_MAGIC = b"urdfsync-stamp 1 "
_HEAD = len(_MAGIC) + 9
_FOLDER, _NAME = ".urdfsync", "stamp"
_TYPE = 0o170000
"""The bits of a mode that `stat.S_IFMT` leaves."""
_VARIABLES = (
    *("ROS_PACKAGE_PATH", "PYTHONPATH", "NO_COLOR", "FORCE_COLOR", "TERM", "COLORTERM", "COLUMNS", "LINES"),
    *("TTY_COMPATIBLE", "TTY_INTERACTIVE", "UNICODE_VERSION"),
)
"""What of the environment decides what is found, and how it looks."""

Paths = dict[str, tuple[int, ...]]
"""What is known of paths: for contents see `looking.Facts`, for kinds the file type alone."""


class Stamp:
    """What was looked at (links themselves first, then targets of links), and what follows from it."""

    def __init__(
        self, program: str, contents: tuple[Paths, Paths], kinds: tuple[Paths, Paths], claims: dict[str, list[str]]
    ) -> None:
        """`program` is who says so; `claims` are answers by their question."""
        self.program, self.contents, self.kinds, self.claims = program, contents, kinds, claims

    def dumps(self, inode: int, written: int) -> bytes:
        """The content of a file of this inode and time (ns). Raises ValueError for what does not fit into it."""
        from array import array

        groups = (*self.contents, *self.kinds)
        strings = [self.program, *(path for group in groups for path in group)]
        for question, answer in self.claims.items():
            strings += (question, str(len(answer)), *answer)
        if any("\0" in text for text in strings):
            raise ValueError("a text holds the separator")
        numbers = [inode, written, *map(len, groups), *(n for group in groups for ns in group.values() for n in ns)]
        try:
            body = array("q", numbers).tobytes() + "\0".join(strings).encode("utf-8", "surrogateescape")
        except OverflowError as error:
            raise ValueError(str(error)) from None
        return b"%s%08x\n%s" % (_MAGIC, zlib.crc32(body), body)


class Reading:
    """A stamp file that was read; its parts are unpacked when they are needed."""

    def __init__(self, content: bytes, inode: int, written: int) -> None:
        """Raises ValueError or LookupError unless `content` is that of a stamp, in a file of this inode and time."""
        body = memoryview(content)[_HEAD:]
        if content[:_HEAD] != b"%s%08x\n" % (_MAGIC, zlib.crc32(body)):
            raise ValueError("no stamp")
        head = body[: 6 * 8].cast("q").tolist()
        if head[:2] != [inode, written]:
            raise ValueError("a copy of a stamp")  # such as one from version control, which nobody should believe
        self._counts = head[2:]
        size = 8 * (6 + 6 * sum(self._counts[:2]) + sum(self._counts[2:]))
        self._numbers = body[6 * 8 : size].cast("q").tolist()
        self._strings = bytes(body[size:]).decode("utf-8", "surrogateescape").split("\0")
        self.program = self._strings[0]
        self.claims: dict[str, list[str]] = {}
        rest = 1 + sum(self._counts)
        while rest < len(self._strings):
            begin = rest + 2
            end = begin + int(self._strings[rest + 1])
            self.claims[self._strings[rest]], rest = self._strings[begin:end], end

    def stands(self) -> bool:
        """Whether all is as it was when the stamp was written."""
        found: list[int] = []
        own, targets, own_kinds, target_kinds = self._groups()
        try:
            for paths, status in ((own, os.lstat), (targets, os.stat)):
                for path in paths:
                    seen = status(path)
                    found += (seen.st_mode, seen.st_ino, seen.st_dev, seen.st_size, seen.st_mtime_ns, seen.st_ctime_ns)
            for paths, status in ((own_kinds, os.lstat), (target_kinds, os.stat)):
                for path in paths:
                    try:
                        found.append(status(path).st_mode & _TYPE)
                    except (FileNotFoundError, NotADirectoryError):
                        found.append(0)
        except (OSError, ValueError):
            return False
        return found == self._numbers

    def stamp(self) -> Stamp:
        """All of it."""
        numbers, groups = iter(self._numbers), self._groups()
        widths = (6, 6, 1, 1)
        own, targets, own_kinds, target_kinds = (
            {path: tuple(next(numbers) for _ in range(width)) for path in paths}
            for paths, width in zip(groups, widths, strict=True)
        )
        return Stamp(self.program, (own, targets), (own_kinds, target_kinds), self.claims)

    def _groups(self) -> list[list[str]]:
        """The paths, as in the file: of contents and of kinds, links themselves before targets."""
        groups, begin = [], 1
        for count in self._counts:
            groups.append(self._strings[begin : begin + count])
            begin += count
        return groups


def program() -> str:
    """Who says what a stamp says: another version or another user may come to other conclusions."""
    user = os.geteuid() if hasattr(os, "geteuid") else 0
    return repr((__version__, sys.version, sys.prefix, sys.byteorder, user, __file__))


def configuration(arguments: list[str]) -> str | None:
    """The configuration that a command is about, absolute; None if there is none."""
    folder = os.getcwd()  # noqa: PTH109 - no pathlib here
    for number, argument in enumerate(arguments, start=1):
        if argument == "--config":
            return os.path.join(folder, *arguments[number : number + 1])  # noqa: PTH118
        if argument.startswith("--config="):
            return os.path.join(folder, argument.removeprefix("--config="))  # noqa: PTH118
    while not os.path.isfile(file := os.path.join(folder, CONFIGURATION)):  # noqa: PTH113, PTH118
        if folder == (folder := os.path.dirname(folder)):  # noqa: PTH120
            return None
    return file


def question(arguments: list[str], file: str) -> str:
    """A command with all that its answer depends on beside what is on disk."""
    looks = ((stream.isatty(), stream.encoding) for stream in (sys.stdout, sys.stderr))
    variables = map(os.environ.get, _VARIABLES)
    return repr((arguments, file, os.getcwd(), *looks, *variables))  # noqa: PTH109


def place(file: str) -> str:
    """Where the stamp of a configuration is."""
    return os.path.join(os.path.dirname(file), _FOLDER, _NAME)  # noqa: PTH118, PTH120


def read(path: str) -> Reading | None:
    """The stamp at a path, if there is one of this program's."""
    try:
        with open(path, "rb") as file:  # noqa: PTH123
            status = os.fstat(file.fileno())
            reading = Reading(file.read(), status.st_ino, status.st_mtime_ns)
    except (OSError, ValueError, LookupError):
        return None
    return reading if reading.program == program() else None


def answer(question: str, path: str) -> list[str] | None:
    """What a stamp says, if it says anything and all still is as it was."""
    reading = read(path)
    claim = reading.claims.get(question) if reading else None
    return claim if claim is not None and reading and reading.stands() else None


def repeat(arguments: list[str]) -> int | None:
    """Say again what a command has said; its exit code, or None if it has to be carried out."""
    if not arguments or arguments[0] not in COMMANDS or sys.stdout is None or sys.stderr is None:
        return None
    try:
        file = configuration(arguments)
        said = answer(question(arguments, file), place(file)) if file else None
    except OSError:
        return None  # said by the command
    if said is None:
        return None
    with streams.guarded() as output:
        for name, text in zip(said[::2], said[1::2], strict=True):
            (output if name == streams.OUTPUT else sys.stderr).write(text)
        if output.trouble:
            from urdfsync import cli

            return cli.unwritten(output)
    return 0


def since_begin() -> int:
    """Nanoseconds since the program has been loaded, or more."""
    return passed(_BEGUN)


def passed(begin: tuple[int, int]) -> int:
    """Nanoseconds since both clocks showed this, or more: one of them may have been set, the other have slept."""
    return max(time.monotonic_ns() - begin[0], time.time_ns() - begin[1])
