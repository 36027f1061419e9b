"""The corpus of real URDF files: its folder and its files. It is beside the repository, never inside."""

from __future__ import annotations

import functools
import hashlib
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from lxml import etree

REPOSITORY = Path(__file__).resolve().parents[2]
FOLDER = Path(os.environ.get("URDFSYNC_CORPUS") or REPOSITORY.parent / "shared" / "corpus")
ABSENT = "no-corpus"
"""Replaces all files if there is no corpus: the fixture `corpus` then skips tests."""


@functools.cache
def robots() -> tuple[str, ...]:
    """Paths of the robots in the corpus folder, each robot once."""
    return _files("robots") or (ABSENT,)


@functools.cache
def distinct_files() -> tuple[str, ...]:
    """Paths of all robots and of all versions of the histories, every content once."""
    by_content: dict[bytes, str] = {}
    for file in (*_files("robots"), *_files("histories")):
        by_content.setdefault(hashlib.sha256((FOLDER / file).read_bytes()).digest(), file)
    return tuple(by_content.values()) or (ABSENT,)


def by_source(files: Iterable[str]) -> Mapping[str, Sequence[str]]:
    """The files by origin: each robot alone, all versions of one history together."""
    result: dict[str, list[str]] = {}
    for file in files:
        name = Path(file).parent.name.removesuffix(".urdf") if file.startswith("histories") else label(file)
        result.setdefault(name, []).append(file)
    return result


@functools.cache
def moving_joints() -> Mapping[str, int]:
    """Per robot, the number of its joints that are not fixed."""
    return {file: 0 if file == ABSENT else _moving_joints(FOLDER / file) for file in robots()}


def label(file: str) -> str:
    """A short name for a file of the corpus, unique among robots: its path without the usual folders."""
    parts = [part for part in Path(file).with_suffix("").parts if part not in ("robots", "urdf", "xacro_generated")]
    return f"{parts[0]}-{parts[-1]}" if parts else file


def _files(below: str) -> tuple[str, ...]:
    paths = (path for path in sorted((FOLDER / below).rglob("*.urdf")) if path.is_file())
    return tuple(path.relative_to(FOLDER).as_posix() for path in paths)


def _moving_joints(path: Path) -> int:
    root = etree.parse(path, etree.XMLParser(recover=True)).getroot()
    return sum(joint.get("type") != "fixed" for joint in root.findall("joint"))
