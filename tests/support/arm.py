"""The package of the six-axis example, which tests damage."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path

from support.corpus import REPOSITORY
from urdfsync.analysis.checks.contents import package_texts
from urdfsync.analysis.checks.package import PackageTexts

FOLDER = REPOSITORY / "modelica" / "UrdfSync" / "Examples" / "SixAxisArm"
NAME = "UrdfSync.Examples.SixAxisArm"
ELBOW = "Joints/Elbow.mo"
OWNERS = {ELBOW: "joint elbow", "SixAxisArm.mo": "robot"}
HOME = Path("/home/ada")
DISK = HOME / "Plant" / "SixAxisArm"
"""The folder of the package in messages."""


_KEPT = {"Joints", "Elbow", "ElbowParameters", "Shoulder", "ShoulderParameters", "Turret", "package"}


@functools.cache
def texts() -> Mapping[str, bytes]:
    """Some generated files of the package: the robot, its benches, and a few joints."""
    found = package_texts(FOLDER)
    kept = {path: text for path, text in found.items() if _kept(path)}
    return {path: _ordered(text) if path.endswith(".order") else text for path, text in kept.items()}


def _kept(path: str) -> bool:
    folder, _, name = path.rpartition("/")
    return folder in ("", "Joints") and (not folder or name.partition(".")[0] in _KEPT)


def _ordered(order: bytes) -> bytes:
    names = [name for name in order.decode().split() if name in _KEPT or name.startswith("SixAxisArm")]
    return "".join(f"{name}\n" for name in names).encode()


def text(path: str = ELBOW) -> str:
    """One of them."""
    return texts()[path].decode()


def changed(old: str, new: str, path: str = ELBOW) -> Mapping[str, str]:
    """Return a file with other words in one place."""
    assert text(path).count(old) == 1, old
    return {path: text(path).replace(old, new)}


def line(words: str, path: str = ELBOW) -> int:
    """Return the line of a file in which these words begin."""
    return text(path)[: text(path).index(words)].count("\n") + 1


def package(edits: Mapping[str, str | bytes | None] | None = None, name: str = NAME) -> PackageTexts:
    """The package with some files edited, added, or, with None, deleted."""
    files: dict[str, bytes] = dict(texts())
    for path, content in (edits or {}).items():
        files.pop(path, None)
        if content is not None:
            files[path] = content.encode() if isinstance(content, str) else content
    edited = [path for path in files if path in texts() and files[path] != texts()[path]]
    return PackageTexts(name, DISK, files, OWNERS, edited)
