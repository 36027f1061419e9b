"""Completion in shells: prints the script for one, and answers what that asks.

A shell waits for the answer at each TAB, so nothing is imported here that takes longer than a few ms: options come from
a table of all parsers, robots and joints from the configuration and the recorded state. Whatever is wrong with these,
there is nothing to complete, and nothing is said. Names that a shell could take for more than a name are left out: a
project may be a stranger's.
"""

from __future__ import annotations

import os
import sys

from urdfsync import uptodate
from urdfsync.dependencies import read_unrecorded

TYPE_CHECKING = False  # that of `typing` takes 2 ms
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

SHELLS = ("bash", "zsh", "fish")
FILES = [(":files", "")]
"""An answer that leaves it to the shell to complete a file."""
_FOLDER = os.path.join(os.path.dirname(__file__), "shells")
_STATE = ".urdfsync/robots"
_LARGEST = 500_000
"""Bytes of a configuration that are read in a fifth of a second; hundreds of robots have fewer."""
_SAFE = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-")


def answer(arguments: list[str]) -> bool:
    """Print what `urdfsync completion SHELL`, or its script with words of a line, asks for; False for anything else."""
    if not arguments or arguments[0] not in SHELLS or arguments[1:2] not in ([], ["--"]):
        return False
    if len(arguments) == 1:
        sys.stdout.write(_read(f"completion.{arguments[0]}"))
    else:
        sys.stdout.writelines(f"{name}\t{words}".rstrip() + "\n" for name, words in complete(arguments[2:]))
    return True


def complete(words: list[str]) -> list[tuple[str, str]]:
    """Return what the last word may become, each with its meaning."""
    words = words or [""]
    table = [line.split("\t") for line in _read("options.tsv").splitlines()]
    rows = [row for row in table if row[0] == (words[0] if words[1:] else "")]
    *before, current = words
    if not before:
        return _matching(current, [(row[1], row[3]) for row in rows])
    kinds, begin = {row[1]: row[2] for row in rows if row[1]}, ""
    if current.startswith("--") and "=" in current:
        option, _, current = current.partition("=")
        before, begin = [*before, option], f"{option}="
    kind = kinds.get(before[-1], "")
    if kind or begin:
        found = _values(kind, current, words)
        return found if found is FILES else [(begin + name, text) for name, text in found]
    if current.startswith("-"):
        return _matching(current, [(row[1], row[3]) for row in rows if row[1].startswith("-") and row[1] not in before])
    found = []
    for kind in (row[2] for row in rows if not row[1]):
        if "--edits" in before and kind == "SOURCE":
            kind = "PATH"
        if (more := _values(f"{kind} of a command", current, words)) is FILES:
            return found or FILES
        found += more
    return found


def _values(kind: str, begun: str, words: list[str]) -> list[tuple[str, str]]:
    """Return the values of an option, or of an argument `of a command`, that go on as begun."""
    kind, _, is_argument = kind.partition(" ")
    if kind == "ROBOT" or (kind == "SOURCE" and words[0] == "diff"):
        found = _matching(begun, [(name, "robot") for name in _robots(words) if name not in words[1:-1]])
        return found or (FILES if kind == "SOURCE" else [])
    if kind == "PATH" and is_argument:
        return _matching(begun, [(path, "edited") for path in _edited(words, begun)]) or FILES
    if form := {"OLD=NEW": "{}=", "NAME=VALUE": "robot.{}.parameters.", "PATTERN": "robot.{}."}.get(kind):
        return _matching(begun, [(form.format(name), "joint") for name in _joints(words)])
    if "|" in kind:
        return _matching(begun, [(name, "") for name in kind.split("|")])
    return FILES if kind.startswith(("FILE", "PATH", "SOURCE", "CONFIG")) else []


def _matching(begun: str, pairs: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    return [pair for pair in dict(pairs).items() if pair[0].startswith(begun)]


def _robots(words: list[str]) -> list[str]:
    """Return the robots of the configuration that a line is about."""
    import tomllib  # 10 ms, which options do without

    try:
        content = read_unrecorded(uptodate.find_config(words) or "")
        robots = tomllib.loads(content.decode("utf-8-sig"))["robots"] if len(content) < _LARGEST else []
        return [name for name in robots if _SAFE.issuperset(name)]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return []


def _facts(words: list[str]) -> Iterator[tuple[str, str, str]]:
    """Yield the lines of recorded states: the folder of the configuration, the first word, and the rest.

    They are those of the robots on the line, if there are any.
    """
    root = os.path.dirname(uptodate.find_config(words) or "")
    try:
        states = sorted(os.listdir(os.path.join(root, _STATE))) if root else []
        named = [name for name in states if name.removesuffix(".state") in words]
        for name in named or [name for name in states if name.endswith(".state")]:
            for line in read_unrecorded(os.path.join(root, _STATE, name)).decode().splitlines():
                word, _, rest = line.partition(" ")
                yield root, word, rest
    except (OSError, ValueError):
        return


def _joints(words: list[str]) -> list[str]:
    """Return the joints that were built last, as far as their names are those of components, too."""
    begin = '["joints","'
    names = [rest[len(begin) :].partition('"')[0] for _, word, rest in _facts(words) if rest.startswith(begin) and word]
    return [name for name in names if name.isidentifier() and name.isascii()]


def _edited(words: list[str], begun: str) -> list[str]:
    """Return the files of packages that are not as they were written last, as seen from the working folder."""
    import hashlib

    folder, hashes = "", dict[str, set[str]]()
    for root, word, rest in _facts(words):
        if word == "folder":
            folder = os.path.relpath(os.path.join(root, rest.strip('"')))
        elif word == "file":
            sha256, _, path = rest.partition("  ")
            hashes.setdefault(os.path.join(folder, path), set()).add(sha256)
    edited = []
    for path, known in hashes.items():
        if path.startswith(begun) and path.endswith(".mo") and path.isprintable():
            try:
                content = read_unrecorded(path).replace(b"\r\n", b"\n").replace(b"\r", b"\n")
            except OSError:
                continue
            if hashlib.sha256(content).hexdigest() not in known:
                edited.append(path)
    return edited


def _read(name: str) -> str:
    with open(os.path.join(_FOLDER, name), encoding="utf-8") as file:
        return file.read()
