"""Answers `build` and `status` while nothing has changed, without loading the rest of the program.

Each robot's last result is remembered with its dependencies, and so are the configuration and its robots. If all these
hold, and no robot has more to tell than one line, this module writes these lines. Otherwise the command runs, and asks
the memory again. Each command begins here, so this module imports only fast modules: argparse
would take 15 of 25 ms.
"""

from __future__ import annotations

import os
import sys

from urdfsync.common import streams
from urdfsync.common.dependencies.memory import CONFIGURATION, ROBOT, Memory

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 25 ms
if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from typing import TextIO

FILE_NAME = "urdfsync.toml"
NONE = "-"
"""Stands for no words in a record."""
IN_STEP = "hook"
"""Says in a robot's record that the robot is in step, which is all that a hook wants to know."""
MANY = 10
"""The greatest number of robots of which each has its line, even if there is nothing to tell about it."""
_OPTIONS = {"build": ("--check", "--dry-run", "-n"), "status": ()}
"""The options after which a command without any work says the same."""
_QUIET = frozenset(("-q", "--quiet"))
_STYLES = {"bold": "1", "dim": "2", "green": "32"}
"""What rich writes for these styles."""


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
    while not os.path.isfile(file := os.path.join(folder, FILE_NAME)):
        if folder == (folder := os.path.dirname(folder)):
            return None
    return file


def find_lines(arguments: Sequence[str]) -> list[tuple[str, str, str, int]] | None:
    """Return for each robot its name, its line, and the sentence about its findings with their number.

    Returns None if the command has to run.
    """
    command, *rest = arguments or [""]
    named, modes, words = list[str](), 0, iter(rest)
    for word in words:
        if word == "--config":
            next(words, "")
        elif not word.startswith("-"):
            named.append(word)
        elif word in _OPTIONS.get(command, ()):
            modes += 1
        elif word not in _QUIET and not word.startswith("--config="):
            return None
    if command not in _OPTIONS or modes > 1 or (file := find_config(arguments)) is None:
        return None
    memory = Memory(state_folder(file))
    told = recall(memory, file, command, named)
    # sources and folders name robots, too
    if not told or not told.keys() >= set(named):
        return None
    if any(not memory.told(robot).issuperset(keys) for robot, (_, _, _, *keys) in told.items()):
        return None
    return [(robot, line, end.removeprefix(NONE), len(keys)) for robot, (line, _, end, *keys) in told.items()]


def recall(memory: Memory, config_file: str, command: str, named: Collection[str] = ()) -> dict[str, Sequence[str]]:
    """Return what is remembered of each robot, if all results hold, and have all that a command would say.

    Returns nothing if the command has to find that out. `named` are the robots that matter; none for all.
    """
    told: dict[str, Sequence[str]] = {}
    configuration = memory.recall(f"{os.path.basename(config_file)}{CONFIGURATION}")
    words = iter(configuration.words if configuration else ())
    for robot, key in zip(words, words, strict=True):
        if not named or robot in named:
            known = memory.recall(f"{robot}{ROBOT}", key)
            if not known or len(known.words) < 3 or command not in known.words[1].split():
                return {}
            told[robot] = known.words
    return told


def is_in_step(config_file: str) -> bool:
    """Return whether all robots of a configuration are in step; False if that has to be found out."""
    return bool(recall(Memory(state_folder(config_file)), config_file, IN_STEP))


def state_folder(config_file: str) -> str:
    """Return the folder of the recorded state of a configuration."""
    return os.path.join(os.path.dirname(config_file), ".urdfsync")


def answer(arguments: Sequence[str]) -> str | None:
    """Write the lines of a command that has nothing to do; return None if the command has to run.

    Otherwise returns why the output is incomplete; an empty string if it is complete.
    """
    if sys.stdout is None or sys.stderr is None or (lines := find_lines(arguments)) is None:
        return None
    with streams.SafeStreams() as output:
        if _QUIET.isdisjoint(arguments):
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
