"""Answers `build` and `status` while nothing has changed, without loading the rest of the program.

Each robot has a record of its dependencies, and the configuration has one, too: what reading it has read, and its
robots. If all records hold, and no robot has more to tell than one line, this module writes these lines. Otherwise the
command runs, and asks the records again. Each command begins here, so this module imports only fast modules: argparse
would take 15 of 25 ms.
"""

from __future__ import annotations

import os
import sys

from urdfsync import streams
from urdfsync.dependencies import record
from urdfsync.dependencies.record import DependencyRecord, FactList

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 25 ms
if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import TextIO

    from urdfsync.dependencies.facts import Entry, Facts
    from urdfsync.dependencies.reads import Reads

CONFIGURATION = "urdfsync.toml"
NONE = "-"
"""Stands for no words in a record."""
IN_STEP = "hook"
"""Says in a robot's record that the robot is in step, which is all that a hook wants to know."""
MANY = 10
"""The greatest number of robots of which each has its line, even if there is nothing to tell about it."""
ROBOT = ".robot"
"""The ending of the names of robots' records."""
_STATE = ".urdfsync"
_OPTIONS = {"build": ("--check", "--dry-run", "-n"), "status": ()}
"""The options after which a command without any work says the same."""
_STYLES = {"bold": "1", "dim": "2", "green": "32"}
"""What rich writes for these styles."""


class CommandLine:
    """A command line that this module understands."""

    def __init__(self, arguments: Sequence[str]) -> None:
        """Raises ValueError for any other command line."""
        self.command, *rest = arguments or [""]
        self.quiet, self.robots, self.mode = False, list[str](), ""
        if self.command not in _OPTIONS:
            raise ValueError(self.command)
        words = iter(rest)
        for word in words:
            if word == "--config":
                next(words, "")
            elif word in ("-q", "--quiet"):
                self.quiet = True
            elif word in _OPTIONS[self.command] and not self.mode:
                self.mode = word
            elif not word.startswith("-"):
                self.robots.append(word)
            elif not word.startswith("--config="):
                raise ValueError(word)


def find_config(arguments: Sequence[str]) -> str | None:
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


def find_lines(arguments: Sequence[str]) -> list[tuple[str, str, str, int]] | None:
    """Return for each robot its name, its line, and the sentence about its findings with their number.

    Returns None if the command has to run.
    """
    try:
        request, file = CommandLine(arguments), find_config(arguments)
    except ValueError:
        return None
    if file is None:
        return None
    seen: dict[Entry, Facts] = {}
    keys = robot_keys(file, seen)
    if keys is None or not keys.keys() >= set(request.robots):
        return None  # sources and folders name robots, too
    chosen = [robot for robot in keys if not request.robots or robot in request.robots]
    lines, folder = [], _state_folder(file)
    for robot in chosen:
        words = _words(folder, robot, keys[robot], request.command, seen)
        if words is None or not record.findings_told(folder, robot).issuperset(words[3:]):
            return None
        lines.append((robot, words[0], words[2].removeprefix(NONE), len(words) - 3))
    return lines or None


def is_in_step(config_file: str) -> bool:
    """Return whether all robots of a configuration are in step; False if that has to be found out."""
    seen: dict[Entry, Facts] = {}
    keys, folder = robot_keys(config_file, seen), _state_folder(config_file)
    return bool(keys) and all(_words(folder, robot, key, IN_STEP, seen) for robot, key in (keys or {}).items())


def robot_keys(config_file: str, seen: dict[Entry, Facts]) -> dict[str, str] | None:
    """Return what `remember` got: the key of each robot's record by name; None if the configuration has to be read."""
    known = record.recall(_state_folder(config_file), _name(config_file), record.surroundings(), seen)
    return dict(zip(known.words[::2], known.words[1::2], strict=True)) if known else None


def _words(folder: str, robot: str, key: str, command: str, seen: dict[Entry, Facts]) -> Sequence[str] | None:
    """Return the words of a robot's record, if it holds and has all that a command would say; else None."""
    known = record.recall(folder, f"{robot}{ROBOT}", key, seen)
    return known.words if known and len(known.words) >= 3 and command in known.words[1].split() else None


def _state_folder(config_file: str) -> str:
    return os.path.join(os.path.dirname(config_file), _STATE)


def _name(config_file: str) -> str:
    return f"{os.path.basename(config_file)}.config"


def answer(arguments: Sequence[str]) -> str | None:
    """Write the lines of a command that has nothing to do; return None if the command has to run.

    Otherwise returns why the output is incomplete; an empty string if it is complete.
    """
    if sys.stdout is None or sys.stderr is None or (lines := find_lines(arguments)) is None:
        return None
    with streams.SafeStreams() as output:
        if not CommandLine(arguments).quiet:
            marks = [("✓ ", "green")] if streams.has_marks(output) else []
            for robot, summary, findings, _ in lines if len(lines) <= MANY else ():
                _write(output, *marks, (robot, "bold"), (f": {summary}", ""))
                if findings:
                    _write(sys.stderr, (f"{robot}: {findings}", "dim"))
            if len(lines) > MANY:
                _write(output, *marks, (robots_in_words(len(lines)), "bold"), (": in step", ""))
                if numbers := [number for *_, number in lines if number]:
                    _write(sys.stderr, (findings_in_words(numbers), "dim"))
        return output.trouble


def robots_in_words(number: int) -> str:
    """Return the subject of a sentence about some of many robots."""
    return "1 robot" if number == 1 else f"{number} robots"


def findings_in_words(numbers: Sequence[int]) -> str:
    """Return a sentence about findings that were told before: the number of each robot that has any."""
    return f"{robots_in_words(len(numbers))}: {still(sum(numbers))}"


def still(findings: int, codes: str = "") -> str:
    """Return a clause about findings that were told before."""
    words, them = ("1 finding", "it") if findings == 1 else (f"{findings} findings", "them")
    return f"still {words}{codes and f' ({codes})'}; --verbose shows {them}"


def _write(stream: TextIO | streams.Stream, *parts: tuple[str, str]) -> None:
    styles = _STYLES if streams.has_colours(stream) else {}
    texts = (f"\x1b[{styles[style]}m{text}\x1b[0m" if style in styles else text for text, style in parts)
    stream.write("".join(texts) + "\n")
    stream.flush()


def remember(config_file: str, reads: Reads, keys: Mapping[str, str]) -> None:
    """Remember what reading a configuration without warnings has read, and the keys of its robots' records."""
    if reads.complete:
        words = [word for entry in keys.items() for word in entry]
        made = DependencyRecord(record.surroundings(), FactList.of(reads), words)
        made.save(_state_folder(config_file), _name(config_file))
