"""The stamp: what commands looked at, and what they said, so that it can be said again while all of that is the same.

It is read before anything else is loaded, so this module imports only what Python has loaded at its start, or what
takes no time. A stamp that can't be read, or that is not from this very place, is none. Wrong or lost, it costs time.
"""

import os
import sys
import time
import zlib

from urdfsync import __version__, streams

TYPE_CHECKING = False  # that of `typing`, whose import takes longer than all that a command without work does
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

COMMANDS = ("build", "status")
"""What can be said again."""
CONFIGURATION = "urdfsync.toml"

BEGUN = time.monotonic_ns(), time.time_ns()
_MAGIC = b"urdfsync-stamp 2 "
_HEAD = len(_MAGIC) + 9
_FOLDER, _NAME = ".urdfsync", "stamp"
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0)
"""A pipe in the place of a stamp is none; nobody waits for it."""
_MANY = 4_000
"""From so many files on, two processes look at them. With an idle core, that takes less time from some 1,500 files on;
without one, the second process only costs its 2 ms, as much as 1,000 files."""
_TYPE = 0o170000
"""The bits of a mode that `stat.S_IFMT` leaves."""
_VARIABLES = (
    *(
        "ROS_PACKAGE_PATH",
        "MODELICAPATH",
        "PYTHONPATH",
        "NO_COLOR",
        "FORCE_COLOR",
        "TERM",
        "COLORTERM",
        "COLUMNS",
        "LINES",
    ),
    *("TTY_COMPATIBLE", "TTY_INTERACTIVE", "UNICODE_VERSION"),
)
"""What of the environment decides what is found, and how it looks."""

Facts = tuple[int, ...]
"""What is known of a path: of a content see `dependencies.Stat`, of a kind the file type alone."""


class Stamp:
    """What was looked at (links themselves first, then targets of links), and what follows from it."""

    def __init__(
        self,
        program: str,
        contents: tuple[dict[str, Facts], dict[str, Facts]],
        kinds: tuple[dict[str, Facts], dict[str, Facts]],
        claims: dict[str, list[str]],
    ) -> None:
        """`program` is who says so; `claims` are answers by their question."""
        self.program, self.contents, self.kinds, self.claims = program, contents, kinds, claims

    def dumps(self, inode: int, written: int) -> bytes:
        """The content of a file of this inode and time (ns). Raises ValueError for what does not fit into it."""
        halves = self._halves()
        parts = [
            [str(inode), str(written), *map(str, self.numbers()), *(str(len(half)) for half in halves), self.program],
            *([folder, *names] for half in halves for folder, names in half.items()),
            *(list(group) for group in (self.contents[1], *self.kinds)),
            *([question, *answer] for question, answer in self.claims.items()),
        ]
        if any(not text or "\0" in text for part in parts for text in part):
            raise ValueError("separators could not be told from texts")
        body = "\0\0".join("\0".join(part) for part in parts).encode("utf-8", "surrogateescape")
        return b"%s%08x\n%s" % (_MAGIC, zlib.crc32(body), body)

    def numbers(self) -> tuple[int, int]:
        """One number for each half of the facts; see `chain`."""
        own, targets = self.contents
        first, second = (
            [[own[f"{folder}{os.sep}{name}"] for name in names] for folder, names in half.items()]
            for half in self._halves()
        )
        return chain(first), chain([*second, *(list(group.values()) for group in (targets, *self.kinds))])

    def _halves(self) -> "tuple[dict[str, list[str]], dict[str, list[str]]]":
        """Names of own files by their folders: first those of half of all paths, then those that go with the rest."""
        own, targets = self.contents
        middle = (len(own) + len(targets) + sum(map(len, self.kinds))) // 2
        halves: tuple[dict[str, list[str]], dict[str, list[str]]] = {}, {}
        for number, path in enumerate(own):
            folder, _, name = path.rpartition(os.sep)
            halves[number >= middle].setdefault(folder, []).append(name)
        return halves


def chain(groups: "Iterable[list[Facts]]") -> int:
    """One number for all facts, in this order; the same in each process of this program, as all of them are integers.

    Chance makes two of them alike once in 2^60 cases; nobody can choose when a file changes, to the nanosecond.
    """
    found = 0
    for facts in groups:
        found = hash((found, *facts))
    return found


class Reading:
    """A stamp file that was read; its parts are unpacked when they are needed."""

    def __init__(self, content: bytes, inode: int, written: int) -> None:
        """Raises ValueError or LookupError unless `content` is that of a stamp, in a file of this inode and time."""
        body = content[_HEAD:]
        if content[:_HEAD] != b"%s%08x\n" % (_MAGIC, zlib.crc32(body)):
            raise ValueError("no stamp")
        parts = body.decode("utf-8", "surrogateescape").split("\0\0")
        own_inode, own_time, first, second, folders, others, self.program = parts[0].split("\0")
        if (own_inode, own_time) != (str(inode), str(written)):
            raise ValueError("a copy of a stamp")  # such as one from version control, which nobody should believe
        self.numbers = int(first), int(second)
        middle = 1 + int(folders)
        end = middle + int(others)
        self._halves = parts[1:middle], parts[middle:end]
        self.targets, *self.kinds = map(_unpacked, parts[end : end + 3])
        claims = (part.partition("\0") for part in parts[end + 3 :])
        self._claims = {question: answer for question, _, answer in claims}

    @property
    def own(self) -> list[str]:
        """The files that were read and are no links."""
        groups = (folder.split("\0") for half in self._halves for folder in half)
        return [f"{folder}{os.sep}{name}" for folder, *names in groups for name in names]

    @property
    def claims(self) -> dict[str, list[str]]:
        """All answers by their question."""
        return {question: _unpacked(answer) for question, answer in self._claims.items()}

    def claim(self, question: str) -> list[str] | None:
        """The answer to a question; None if there is none."""
        answer = self._claims.get(question)
        return None if answer is None else _unpacked(answer)

    def holds(self) -> bool:
        """Whether all is as it was when the stamp was written. Raises OSError if there is no way back here."""
        here = os.getcwd()  # noqa: PTH109
        os.chdir(here)  # fails before it is left if nobody could come back
        try:
            if sum(folder.count("\0") for half in self._halves for folder in half) < _MANY:
                return self._first_holds() and self._second_holds()
            from urdfsync.stamping import beside

            return beside.both(self._first_holds, self._second_holds)
        except (OSError, ValueError):
            return False
        finally:
            os.chdir(here)

    def _first_holds(self) -> bool:
        return chain(map(_files, self._halves[0])) == self.numbers[0]

    def _second_holds(self) -> bool:
        return chain(self._second()) == self.numbers[1]

    def _second(self) -> "Iterator[list[Facts]]":
        yield from map(_files, self._halves[1])
        yield _facts(map(os.stat, self.targets))
        for paths, status in zip(self.kinds, (os.lstat, os.stat), strict=True):
            yield [(_kind(path, status),) for path in paths]


def _unpacked(texts: str) -> list[str]:
    return texts.split("\0") if texts else []


def _files(group: str) -> list[Facts]:
    """The facts of a folder's files. Goes to the folder: otherwise, this takes half as much time again."""
    folder, *names = group.split("\0")
    os.chdir(folder)
    return _facts(map(os.lstat, names))


def _facts(found: "Iterable[os.stat_result]") -> list[Facts]:
    """The same as of `dependencies.stat_of`; in one go, as there are thousands."""
    return [(s.st_mode, s.st_ino, s.st_dev, s.st_size, s.st_mtime_ns, s.st_ctime_ns) for s in found]


def _kind(path: str, status: "Callable[[str], os.stat_result]") -> int:
    try:
        return status(path).st_mode & _TYPE
    except (FileNotFoundError, NotADirectoryError):
        return 0


def program() -> str:
    """Who says what a stamp says: another version or another user may come to other conclusions.

    Rights that a process has beside those of its user and groups are left out.
    """
    user = (os.geteuid(), os.getegid(), *sorted(os.getgroups())) if hasattr(os, "geteuid") else 0
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
        with open(os.open(path, _FLAGS), "rb") as file:  # noqa: PTH123
            status = os.fstat(file.fileno())
            reading = Reading(file.read(), status.st_ino, status.st_mtime_ns)
    except (OSError, ValueError, LookupError):
        return None
    return reading if reading.program == program() else None


def answer(question: str, path: str) -> list[str] | None:
    """What a stamp says, if it says anything and all still is as it was."""
    reading = read(path)
    claim = reading.claim(question) if reading else None
    return claim if claim is not None and reading and reading.holds() else None


def answers(arguments: list[str]) -> bool:
    """Whether a stamp would answer a command."""
    try:
        file = configuration(arguments)
        return file is not None and answer(question(arguments, file), place(file)) is not None
    except OSError:
        return False


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

            return cli.tell_unwritten(output)
    return 0


def now() -> tuple[int, int]:
    """This moment by both clocks, for `passed`."""
    return time.monotonic_ns(), time.time_ns()


def since_begin() -> int:
    """Nanoseconds since the program has been loaded, or more."""
    return passed(BEGUN)


def passed(begin: tuple[int, int]) -> int:
    """Nanoseconds since both clocks showed this, or more: one of them may have been set, the other have slept."""
    return max(time.monotonic_ns() - begin[0], time.time_ns() - begin[1])
