"""Completion in shells: prints the script for a shell, and the answers that this script asks for.

A shell waits for the answer at each TAB, so imports here take a few ms at most. Options come from a table of all
parsers; robots and joints come from the configuration and the recorded state. If these have faults, the answer is
empty. Names with special characters of shells are left out: a stranger may have written the project.
"""

from __future__ import annotations

import os

from urdfsync.common import noop, streams
from urdfsync.common.dependencies.facts import read_unrecorded

SHELLS = ("bash", "zsh", "fish", "powershell")
_SHELLS = os.path.dirname(__file__)
_STATE = ".urdfsync/robots"
_LARGEST = 500_000
"""Largest configuration in bytes: reading it takes a fifth of a second; hundreds of robots need less."""
_LARGEST_STATES = 10_000_000
"""Largest recorded states in bytes: reading them takes a fifth of a second; robots with 10,000 links need as much."""
_SAFE = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-")


def answer(arguments: list[str]) -> bool:
    """Print the script for `urdfsync completion SHELL`, or the answer to that script; False for other arguments."""
    if not arguments or arguments[0] not in SHELLS or arguments[1:2] not in ([], ["--"]):
        return False
    if len(arguments) == 1:
        text = read_unrecorded(f"{_SHELLS}/completion.{arguments[0]}").decode()
    else:
        # PowerShell before version 7.3 drops empty words, so its script puts a dot before each
        words = [word[arguments[0] == "powershell" :] for word in arguments[2:]]
        text = "".join(f"{name}\t{meaning}".rstrip() + "\n" for name, meaning in complete(words))
    with streams.SafeStreams() as output:  # on Windows, too, a shell gets lines without `\r`
        output.write(text)
    return True


def complete(words: list[str]) -> list[tuple[str, str]]:
    """Return the completions of the last word, each with its meaning."""
    *before, current = words or [""]
    table = [line.split("\t") for line in read_unrecorded(f"{_SHELLS}/options.tsv").decode().splitlines()]
    rows = [row for row in table if row[0] == (before[0] if before else "")]  # options of a command, or all commands
    values = {name: values for _, name, values, _ in rows if name}
    option, begin = before[-1] if before else "", ""
    if current.startswith("--") and "=" in current:
        option, _, current = current.partition("=")
        begin = f"{option}="
    kinds = values.get(option, "").split("|") if begin or values.get(option) else []
    if not kinds and (not before or current.startswith("-")):
        names = {name: meaning for _, name, _, meaning in rows if name and name not in before}
    else:
        kinds = kinds or "|".join(values for _, name, values, _ in rows if not name).split("|")
        names = {name: "" for kind in kinds for name in _names(kind, words) if name not in before[1:]}
    fitting = [(begin + name, meaning) for name, meaning in names.items() if name.startswith(current)]
    return fitting or ([(":files", "")] if "FILE" in kinds else [])  # lets the shell complete a file


def _names(kind: str, words: list[str]) -> list[str]:
    """Return the values of a kind: robots, texts with a joint in them, or choices; none for other kinds."""
    if kind == "ROBOT":
        return _robots(words)
    if "{}" in kind:
        return [kind.format(joint) for joint in _joints(words)]
    return [kind] if kind and not kind.isupper() else []


def _robots(words: list[str]) -> list[str]:
    """Return the names of the robots in the configuration that a command line means."""
    import tomllib  # takes 10 ms, which completion of an option saves

    try:
        content = read_unrecorded(noop.find_config(words) or "")
        robots = tomllib.loads(content.decode("utf-8-sig"))["robots"] if len(content) < _LARGEST else []
        return [name for name in robots if _SAFE.issuperset(name)]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return []


def _joints(words: list[str]) -> list[str]:
    """Return the joints of the last build whose names are component names: of the robots on the line, else of all."""
    import json  # takes 3 ms: other completions need no state

    folder = os.path.join(os.path.dirname(noop.find_config(words) or ""), _STATE)
    try:
        states = sorted(os.listdir(folder))
        states = [name for name in states if name.removesuffix(".state") in words] or states
        size, texts = 0, list[str]()
        for path in (os.path.join(folder, name) for name in states):
            size += os.stat(path).st_size
            if size > _LARGEST_STATES:
                break
            texts.append(read_unrecorded(path).decode())
        lines = (line for text in texts for line in text.splitlines() if line.startswith("{"))
        names = [str(name) for line in lines for name in json.loads(line)["snapshot"]["joints"]]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return []
    return [name for name in names if name.isidentifier() and name.isascii()]
