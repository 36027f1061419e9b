"""The up-to-date check: say again what a command said, while nothing that its answer depended on has changed.

`.urdfsync/stamp` holds the saved answers of `build`, `status` and the hook, a list of all paths that they depended on,
and a hash of what the system said of these paths. A file in any other state is no answer, and the command runs.
The check comes before all else that a command does, so this module imports only what loads in a fraction of a ms:
contextlib would take 1 of 12.
"""

from __future__ import annotations

import os
import sys

from urdfsync import __version__, streams
from urdfsync.dependencies import LSTAT, MAX_FILE, STAT, VARIABLE, Dependencies, Entries, check_path, is_young

COMMANDS = ("build", "status")
CONFIGURATION = "urdfsync.toml"

_FORMAT = "urdfsync answers 3"
_FOLDER, _NAME = ".urdfsync", "stamp"
_VARIABLES = (
    *("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "MODELICAPATH", "PYTHONPATH", "NO_COLOR", "FORCE_COLOR", "TERM"),
    *("COLORTERM", "COLUMNS", "LINES", "TTY_COMPATIBLE", "TTY_INTERACTIVE", "UNICODE_VERSION"),
)
"""Environment variables that decide which files a command finds, and how its output looks."""
_MAX_ANSWERS = 16
_MAX_CHARACTERS = 2_000_000
"""Longer answers are not saved. That of the hook names all that has to be tracked: 300,000 for 8,000 outputs."""


class SavedAnswers:
    """The content of the file: checks and paths, the hash of what they found, answers by their key."""

    def __init__(self, checks: list[tuple[str, str]], found: int, answers: dict[str, list[str]]) -> None:
        self.checks, self.found, self.answers = checks, found, answers

    def check(self) -> Entries | None:
        """What is at all paths now; None if anything that the answers depended on has changed."""
        try:
            found = {(check, path): check_path(check, path) for check, path in self.checks}
        except (OSError, ValueError):
            return None
        return found if _hash(found) == self.found else None


def _hash(found: Entries) -> int:
    """A hash of what was found at all paths; Python gives tuples of integers the same one in each process."""
    return hash(tuple(found.values()))


def _program() -> str:
    """Who saved an answer: another version or another user may come to another one."""
    user = (os.geteuid(), os.getegid(), *sorted(os.getgroups())) if hasattr(os, "geteuid") else 0
    return repr((__version__, sys.version, sys.prefix, sys.byteorder, user, __file__))


def find_config(arguments: list[str]) -> str | None:
    """The absolute path of the configuration that a command is about; None if there is none."""
    try:
        folder = os.getcwd()
    except FileNotFoundError:
        return None  # somebody has deleted it, and the command reports it
    for number, argument in enumerate(arguments, start=1):
        if argument == "--config":
            return os.path.join(folder, *arguments[number : number + 1])
        if argument.startswith("--config="):
            return os.path.join(folder, argument.removeprefix("--config="))
    while not os.path.isfile(file := os.path.join(folder, CONFIGURATION)):
        if folder == (folder := os.path.dirname(folder)):
            return None
    return file


def answer_key(arguments: list[str], config_file: str) -> str:
    """A command with all that its answer depends on beside files."""
    terminals = ((stream.isatty(), stream.encoding) for stream in (sys.stdout, sys.stderr))
    variables = map(os.environ.get, _VARIABLES)
    return repr((arguments, config_file, os.getcwd(), *terminals, *variables))


def read_answers(config_file: str) -> SavedAnswers | None:
    """The answers saved beside a configuration; None if there are none.

    They count only if this program wrote them in this very file: a copy, such as a committed one, is somebody else's.
    """
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0)  # a pipe must not hold it up
    path = os.path.join(os.path.dirname(config_file), _FOLDER, _NAME)
    try:
        with open(os.open(path, flags), encoding="utf-8", errors="surrogateescape", newline="") as file:
            status = os.fstat(file.fileno())
            text = file.read() if status.st_size <= MAX_FILE else ""
        ours = "\0".join([_FORMAT, str(status.st_ino), str(status.st_mtime_ns), _program(), ""])
        if not text.startswith(ours):  # nobody else's is taken apart, which could take minutes
            return None
        head, checks, *answers, end = [section.split("\0") for section in text.split("\0\0")]
        *_, found = head
        if end != [str(len(answers))]:
            return None
        pairs = list(zip(checks[::2], checks[1::2], strict=True))
        return SavedAnswers(pairs, int(found), {key: answer for key, *answer in answers})
    except (OSError, ValueError):
        return None


def find_answer(config_file: str, key: str) -> list[str] | None:
    """A saved answer whose dependencies have not changed; None if there is none."""
    saved = read_answers(config_file)
    answer = saved.answers.get(key) if saved else None
    return answer if answer is not None and saved and saved.check() is not None else None


def saved_answer(arguments: list[str]) -> list[str] | None:
    """The saved answer of a command; None if there is none, or if it does not hold any more."""
    config_file = find_config(arguments)
    return find_answer(config_file, answer_key(arguments, config_file)) if config_file else None


def print_answer(arguments: list[str]) -> str | None:
    """Print the saved answer of a command; None if there is none, so that the command runs.

    Returns why not all of it could be written; an empty string if it could.
    """
    if not arguments or arguments[0] not in COMMANDS or sys.stdout is None or sys.stderr is None:
        return None
    answer = saved_answer(arguments)
    if answer is None:
        return None
    with streams.SafeStreams() as output:
        for name, text in zip(answer[::2], answer[1::2], strict=True):
            (output if name == streams.OUTPUT else sys.stderr).write(text)
        return output.trouble


def save_answer(config_file: str, key: str, answer: list[str], dependencies: Dependencies) -> None:
    """Save the answer of a command that exited with 0.

    Nothing is saved if one of the dependencies has just changed, or if it is not certain that they are all there are.
    """
    from pathlib import PurePath  # 10 ms, which the check does without

    if not dependencies.complete or sum(map(len, answer)) > _MAX_CHARACTERS:
        return
    here, folder = os.getcwd(), os.path.join(os.path.dirname(config_file), _FOLDER)
    dependencies.add_modules()
    recorded = {
        (check, path if check == VARIABLE else os.path.join(here, path)): found
        for (check, path), found in dependencies.entries.items()
    }
    if (STAT, str(PurePath(config_file))) not in recorded:
        return  # such as `--help`, which reads nothing
    if any(is_young(found, dependencies.started) for (check, _), found in recorded.items() if check in (LSTAT, STAT)):
        return
    answers, saved = {key: answer}, read_answers(config_file)
    before = saved.check() if saved and len(saved.answers) < _MAX_ANSWERS else None
    if saved and before and all(before.get(pair, found) == found for pair, found in recorded.items()):
        recorded, answers = before | recorded, saved.answers | answers
    listed = [[found, *texts] for found, texts in answers.items()]
    checks = [text for pair in recorded for text in pair]
    if any(not text or "\0" in text for section in (checks, *listed) for text in section):
        return  # the file can't hold that
    temporary = os.path.join(folder, ".stamp.urdfsync-tmp")
    try:
        descriptor = _create(temporary)
        try:
            status = os.fstat(descriptor)  # which the file is bound to
            os.utime(descriptor, ns=(0, 0))
            if os.name == "nt" or os.fstat(descriptor).st_ctime_ns < status.st_ctime_ns:
                return  # on Windows, FAT and sshfs, a file has no time of change that nobody can set
            head = [_FORMAT, str(status.st_ino), str(status.st_mtime_ns), _program(), str(_hash(recorded))]
            text = "\0\0".join("\0".join(section) for section in (head, checks, *listed, [str(len(listed))]))
            os.write(descriptor, text.encode("utf-8", "surrogateescape"))
            os.utime(descriptor, ns=(status.st_mtime_ns, status.st_mtime_ns))
            os.replace(temporary, os.path.join(folder, _NAME))
        finally:
            os.close(descriptor)
            _remove(temporary)
    except (OSError, ValueError):
        return  # the next command runs, as this one did


def _create(path: str) -> int:
    """Create and open a file in a state folder. Raises OSError.

    No link is followed: a repository may have committed some that lead elsewhere.
    """
    if os.path.islink(os.path.dirname(path)):
        raise NotADirectoryError
    _remove(path)  # left by a process that was killed
    return os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)


def _remove(path: str) -> None:
    if os.path.lexists(path):
        os.unlink(path)
