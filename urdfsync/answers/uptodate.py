"""The up-to-date check: repeats the answer of a command while its dependencies are unchanged.

`.urdfsync/stamp-build` holds the last answer of `build`, the list of all read files, and a hash of the facts about
these files. The commands `status` and `hook` have such files, too. If anything has changed, the command runs. The list
contains the program's own modules: developers change them. A file that was young when it was read is compared by its
content, as in git's racy index entries. Once all files are old, the answer is written again: later checks compare stat
values. Each command begins with the check, so this module imports only fast modules: contextlib would take 1 of 12 ms.
"""

from __future__ import annotations

import os
import stat
import sys
import time

from urdfsync import __version__
from urdfsync.answers import streams
from urdfsync.answers.facts import (
    CONTENTS,
    LSTAT,
    LSTAT_TYPE,
    MAX_FILE,
    STAT_TYPE,
    VARIABLE,
    Entry,
    check_path,
    hash_file,
    is_young,
)

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of the check
if TYPE_CHECKING:
    from urdfsync.answers.dependencies import Dependencies

COMMANDS = ("build", "status")
CONFIGURATION = "urdfsync.toml"

_FORMAT = "urdfsync answer 5"
_OLD = "-"
"""Stands for the hash of an old file, which is compared by its stat values."""
_VARIABLES = (
    *("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "MODELICAPATH", "PYTHONPATH", "NO_COLOR", "FORCE_COLOR", "TERM"),
    *("COLORTERM", "COLUMNS", "LINES", "TTY_COMPATIBLE", "TTY_INTERACTIVE", "UNICODE_VERSION"),
)
"""Environment variables that change the files that a command finds, or the look of its output."""
_MAX_CHARACTERS = 2_000_000
"""Longer answers are not saved."""


def _stamp(config_file: str, command: str) -> str:
    """Return the path of a command's saved answer."""
    return os.path.join(os.path.dirname(config_file), ".urdfsync", f"stamp-{command}")


def _program() -> str:
    """Return the identity of the program and of its user: another version or user may get another answer."""
    user = (os.geteuid(), os.getegid(), *sorted(os.getgroups())) if hasattr(os, "geteuid") else 0
    return repr((__version__, sys.version, sys.prefix, sys.byteorder, user, __file__))


def find_config(arguments: list[str]) -> str | None:
    """Return the absolute path of a command's configuration file; None if there is none."""
    try:
        folder = os.getcwd()
    except FileNotFoundError:
        return None  # the working folder was deleted: the command reports it
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
    """Return a text of all inputs of a command's answer other than files."""
    terminals = ((stream.isatty(), stream.encoding) for stream in (sys.stdout, sys.stderr))
    variables = map(os.environ.get, _VARIABLES)
    return repr((arguments, config_file, os.getcwd(), *terminals, *variables))


def find_answer(config_file: str, command: str, key: str) -> list[str] | None:
    """Return the saved answer of a command, if its dependencies are unchanged; None otherwise.

    Only the file that this program wrote on this machine counts: a copy, such as a committed copy, is ignored.
    """
    try:
        return _find_answer(_stamp(config_file, command), key)
    except (OSError, ValueError):
        return None


def _find_answer(stamp: str, key: str) -> list[str] | None:
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0)  # opening a pipe must not block
    with open(os.open(stamp, flags), encoding="utf-8", errors="surrogateescape", newline="") as file:
        status = os.fstat(file.fileno())
        text = file.read() if status.st_size <= MAX_FILE else ""
    if not text.startswith(f"{_bound(status)}\0\0"):  # parsing a forged file could take minutes
        return None
    _, (facts_hash,), read, (saved_key, *answer), end = [section.split("\0") for section in text.split("\0\0")]
    paths, hashes, started = read[1::3], read[2::3], time.time_ns()
    facts = tuple(check_path(check, path) for check, path in zip(read[::3], paths, strict=True))
    # Python gives tuples of integers the same hash in each process
    if saved_key != key or hash(facts) != int(facts_hash) or end != ["end"]:
        return None
    young = [number for number, sha256 in enumerate(hashes) if sha256 != _OLD]
    if any(hash_file(paths[number]) != hashes[number] for number in young):
        return None
    if young and not any(is_young(facts[number], started) for number in young):
        read[2::3] = [_OLD] * len(paths)
        _write(stamp, facts_hash, read, [key, *answer])
    return answer


def _bound(status: os.stat_result) -> str:
    """Return the first words of a saved answer: a copy of the file has another inode or time."""
    return "\0".join([_FORMAT, str(status.st_ino), str(status.st_mtime_ns), _program()])


def print_answer(arguments: list[str]) -> str | None:
    """Print the saved answer of a command; returns None if there is none.

    Otherwise returns why the output is incomplete; an empty string if it is complete.
    """
    if not arguments or arguments[0] not in COMMANDS or sys.stdout is None or sys.stderr is None:
        return None
    config_file = find_config(arguments)
    answer = find_answer(config_file, arguments[0], answer_key(arguments, config_file)) if config_file else None
    if answer is None:
        return None
    with streams.SafeStreams() as output:
        for name, text in zip(answer[::2], answer[1::2], strict=True):
            (output if name == streams.OUTPUT else sys.stderr).write(text)
        return output.trouble


def save_answer(config_file: str, command: str, key: str, answer: list[str], dependencies: Dependencies) -> None:
    """Save the answer of a command that exited with 0; it replaces the command's last saved answer.

    Nothing is saved if `dependencies` are incomplete, or if one changed during the command.
    """
    from pathlib import PurePath  # imported here, so that the check saves 10 ms

    if not dependencies.complete or sum(map(len, answer)) > _MAX_CHARACTERS:
        return
    here = os.getcwd()
    dependencies.add_modules()
    read, entries = list[str](), _without_implied(dependencies.entries | dependencies.modules)
    for check, path in entries:
        place = path if check == VARIABLE else os.path.join(here, path)
        read += (check, place, dependencies.hashes.get((check, path), _OLD))
    if str(PurePath(config_file)) not in read:
        return  # `--help`, for example, reads nothing
    if any(not text or "\0" in text for text in (*read, key, *answer)):
        return  # a young file may still change, or the answer can't be stored
    _write(_stamp(config_file, command), str(hash(tuple(entries.values()))), read, [key, *answer])


def _without_implied(entries: dict[Entry, tuple[int, ...]]) -> dict[Entry, tuple[int, ...]]:
    """Return the entries without file types that the stat values of another entry contain."""
    implied = {
        (kind, path, stat.S_IFMT(facts[0]))
        for (check, path), facts in entries.items()
        if check in CONTENTS and facts[0] >= 0
        # the stat values of a symbolic link do not show the type of its target
        for kind in ((LSTAT_TYPE, STAT_TYPE) if check == LSTAT else (STAT_TYPE,))
    }
    return {entry: facts for entry, facts in entries.items() if (*entry, *facts) not in implied}


def _write(stamp: str, facts_hash: str, read: list[str], answer: list[str]) -> None:
    """Write an answer with its key and its dependencies; each has a check, a path, and a hash or `_OLD`."""
    folder = os.path.dirname(stamp)
    temporary = os.path.join(folder, ".stamp.urdfsync-tmp")
    if os.path.islink(folder):  # a repository may have committed a link to another folder
        return
    try:
        _remove(temporary)  # a killed process left this file
        descriptor = os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            status = os.fstat(descriptor)  # the file is valid only with these values
            os.utime(descriptor, ns=(0, 0))
            if os.name == "nt" or os.fstat(descriptor).st_ctime_ns < status.st_ctime_ns:
                return  # on Windows, FAT and sshfs, a user can set all of a file's times
            text = "\0\0".join([_bound(status), facts_hash, "\0".join(read), "\0".join(answer), "end"])
            os.write(descriptor, text.encode("utf-8", "surrogateescape"))
            os.utime(descriptor, ns=(status.st_mtime_ns, status.st_mtime_ns))
            os.replace(temporary, stamp)
        finally:
            os.close(descriptor)
            _remove(temporary)
    except (OSError, ValueError):
        return  # then the next command runs in full, too


def _remove(path: str) -> None:
    if os.path.lexists(path):
        os.unlink(path)
