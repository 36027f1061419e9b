"""Writes changed files as a patch for `git apply`, byte by byte."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterator
from pathlib import Path

from urdfsync.project import git

_ESCAPES = {ord("\\"): "\\\\", ord('"'): '\\"', ord("\n"): "\\n", ord("\t"): "\\t", ord("\r"): "\\r"}


def top_of(folder: Path) -> Path:
    """Return the folder from which a patch's paths count: the top of the working tree, else the folder itself."""
    return Path(git.find_top(folder) or os.path.realpath(folder))


def path_in(top: Path, file: Path) -> str | None:
    """Return the path of a file as a patch has it; None for a file of another working tree, or outside."""
    real = Path(os.path.realpath(file))
    if not real.is_relative_to(top) or git.find_top(real.parent) not in (None, str(top)):
        return None
    return real.relative_to(top).as_posix()


def unified(path: str, old: bytes, new: bytes) -> bytes:
    """Return the difference of two contents of a file; empty if they are equal."""
    lines = [content.decode("latin-1").split("\n") for content in (old, new)]
    first, second = ([*(f"{line}\n" for line in part[:-1]), *filter(None, part[-1:])] for part in lines)
    before, after = (_quoted(f"{side}/{path}") for side in "ab")
    head = b"diff --git %b %b\n--- %b\n+++ %b\n" % (before, after, before, after)
    body = "".join(_with_ends([*difflib.unified_diff(first, second)][2:]))
    return head + body.encode("latin-1") if body else b""


def _with_ends(lines: list[str]) -> Iterator[str]:
    for line in lines:
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _quoted(path: str) -> bytes:
    """Return a path as git writes it: in quotes if it has special characters (`git help diff`, core.quotePath)."""
    escaped = path.translate(_ESCAPES)
    is_plain = escaped == path and " " not in path
    return os.fsencode(path if is_plain else f'"{escaped}"')
