"""Code that the replays share: projects that build each version of a changing robot."""

from __future__ import annotations

import functools
import hashlib
import os
import re
import shutil
import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec

from support import corpus
from support.choices import options
from support.packages import proposed_base, read
from urdfsync.engine.build import build
from urdfsync.engine.result import Result
from urdfsync.modelica.stamp import with_stamp
from urdfsync.project import config
from urdfsync.project.state import statefile

ALL = "URDFSYNC_REPLAYS"
"""Environment variable: a number of steps with random edits; with it, all histories of the corpus are replayed."""
STEPS = int(os.environ.get(ALL, "0"))
PACKAGE = "modelica/Bot"
"""The package's folder; paths of files count from it."""

_CONFIGURATION = """\
[robots.bot]
source = "bot.urdf"
package = "Bot"
base = "{base}"
"""
_MESHES = {True: 'package_paths = ["ros"]\n', False: 'meshes = "skip"\n'}
_MESH = re.compile(rb'filename="(package://|\./)?([\w+-][\w/.+-]*\.stl)"', re.IGNORECASE)

Files = Mapping[str, bytes]
Stamps = Mapping[str, tuple[int, int]]


@functools.cache
def histories() -> Mapping[str, Sequence[bytes]]:
    """The versions of each file in the corpus, by a short name of its history.

    One history has an MJCF in between, whose meshes it lacks.
    """
    folders = sorted((corpus.FOLDER / "histories").glob("*/"))
    versions = {folder: [file.read_bytes() for file in sorted(folder.glob("*.urdf"))] for folder in folders}
    return {
        folder.name.removesuffix(".urdf"): [content for content in contents if b"<mujoco" not in content[:1000]]
        for folder, contents in versions.items()
    }


def base_of(versions: Sequence[bytes]) -> str:
    """The option `base` that `init` proposes for the first readable version."""
    return proposed_base(next(version for version in versions if read(version).snapshot is not None))


class Project:
    """A folder with one robot, its configuration and the results of builds."""

    def __init__(self, root: Path, base: str = "fixed", *, meshes: bool = False) -> None:
        self.root, self.package, self._meshes = root, root / PACKAGE, meshes
        self._configuration = _CONFIGURATION.format(base=base) + _MESHES[meshes]
        (root / "ros").mkdir(parents=True)
        self.configure()

    def configure(self, more: str = "") -> None:
        """Write the configuration, with `more` keys of the robot."""
        (self.root / config.FILE_NAME).write_text(self._configuration + more)

    def save(self, content: bytes) -> None:
        """Export the robot, with the meshes that it refers to."""
        (self.root / "bot.urdf").write_bytes(content)
        if self._meshes:
            _put_meshes(self.root, content)

    def build(self, **request: Any) -> Result:
        """Build once."""
        loaded = config.load(self.root / config.FILE_NAME)
        (result,) = build(loaded, loaded.robots, options(loaded, **request))
        return result

    def files(self) -> Files:
        """Every file of the package."""
        return contents(self.package)

    def state(self) -> Files:
        """The recorded state of the robot."""
        return contents(self.root / ".urdfsync/robots")

    def stamps(self) -> Stamps:
        """Inode and time of change of each file, except the lock and the notes of this machine."""
        found = ((path.relative_to(self.root).as_posix(), path.stat()) for path in _files(self.root))
        found = (
            (name, stat)
            for name, stat in found
            if not name.startswith((".urdfsync/lock", ".urdfsync/notes/", ".urdfsync/deps/"))
        )
        return {name: (stat.st_ino, stat.st_mtime_ns) for name, stat in found}

    def clone(self, root: Path) -> Project:
        """The project as git has it: without the files that `.urdfsync/.gitignore` ignores."""
        cloned = object.__new__(Project)
        cloned.__dict__ |= self.__dict__ | {"root": root, "package": root / PACKAGE}
        shutil.copytree(self.root, root)
        for path in (root / ".urdfsync").glob("*"):
            if path.name not in (".gitignore", ".gitattributes", "schema.json", "robots", "bases"):
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        return cloned


class Fresh:
    """Package and state of each version after a first build; both are empty for an invalid version."""

    def __init__(self, work: Path, base: str = "fixed", *, meshes: bool = False) -> None:
        self._work, self._base, self._meshes = work, base, meshes
        self._built: dict[bytes, tuple[Files, Files]] = {}

    def __call__(self, content: bytes) -> tuple[Files, Files]:
        if content not in self._built:
            shutil.rmtree(self._work, ignore_errors=True)
            project = Project(self._work, self._base, meshes=self._meshes)
            project.save(content)
            failed = project.build().failed
            self._built[content] = ({}, {}) if failed else (project.files(), project.state())
        return self._built[content]


def without_former(content: bytes | None) -> bytes | None:
    """The content of a file without its stamp; of a recorded state, without the facts that tell how it came about."""
    if not content or not content.startswith(b"# What urdfsync built last"):
        return content and with_stamp(content, None)
    records, _ = statefile.loads(content.decode(), "")
    plain: dict[str, Any] = {"former": {}, "former_ids": {}, "ids": {}, "edits": {}, "ancestors": ()}
    text = statefile.dumps(*(msgspec.structs.replace(record, **plain) for record in records))
    return re.sub(r',?"number":\d+', "", text).encode()  # shapes keep their numbers


def contents(folder: Path) -> dict[str, bytes]:
    """Content of each file below a folder, except the notes of this machine."""
    files = {path.relative_to(folder).as_posix(): path.read_bytes() for path in _files(folder)}
    return {
        path: content
        for path, content in files.items()
        if ".urdfsync/notes/" not in path and ".urdfsync/deps/" not in path
    }


def _put_meshes(root: Path, content: bytes) -> None:
    """Write a different tetrahedron for each mesh of a robot, where the robot expects the mesh."""
    for scheme, name in set(_MESH.findall(content)):
        path = root / ("ros" if scheme == b"package://" else "") / name.decode()
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(_tetrahedron(name))
            if scheme == b"package://":
                package = name.decode().partition("/")[0]
                (root / "ros" / package / "package.xml").write_text(f"<package><name>{package}</name></package>")


def _tetrahedron(name: bytes) -> bytes:
    """Binary STL; the edges depend on the name."""
    x, y, z = (0.01 + digit / 1000 for digit in hashlib.sha256(name).digest()[:3])
    corners = [(0.0, 0.0, 0.0), (x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)]
    faces = [[corners[index] for index in face] for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))]
    triangles = [struct.pack("<12fH", 0, 0, 0, *sum(face, ()), 0) for face in faces]
    return bytes(80) + struct.pack("<I", len(faces)) + b"".join(triangles)


def _files(folder: Path) -> Iterator[Path]:
    return (path for path in sorted(folder.rglob("*")) if path.is_file())
