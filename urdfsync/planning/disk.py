"""What is on disk of one robot's package, as one plan sees it: each file is looked at once, and read if need be."""

from __future__ import annotations

import contextlib
import itertools
import os
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

from urdfsync.classfiles import modelica_files, related
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.dependencies import NO_STAT, Stat, is_file, list_folder, read_file, read_stat, stat_of
from urdfsync.diagnostics import OutputError
from urdfsync.domain import Role
from urdfsync.files import Tree, digest, placed, text_digest
from urdfsync.plan import FileRecord, Found

Hashed: TypeAlias = tuple[Stat, str, str]
"""What the system says of a file, and the SHA-256 (hex) of its bytes and of its text, line endings normalised."""
Hashes: TypeAlias = Mapping[str, Hashed | None]
"""Files by their absolute paths; None for what is not there."""


class Disk:
    """The files of one robot's package, addressed by their path from the configuration's folder."""

    def __init__(self, config: Config, robot: RobotConfig, known: Hashes | None = None) -> None:
        """`known` are hashes that hold as long as the system says the same of a file."""
        self._root, self._prefix = config.root, os.path.join(os.path.normpath(config.root), "")  # noqa: PTH118
        self._output = robot.output
        self._trees = [Tree(robot.output, shown), Tree(config.root, shown)]
        self._homes: dict[str, Tree | None] = {}
        """The trees that folders are in; None for a folder that is in none, or not there."""
        self._known = known or {}
        self.hashed: dict[str, Hashed | None] = {}
        """What `look` or `text` first saw at each absolute path."""

    def key(self, path: Path) -> str:
        """How a file is called in manifest and plan."""
        return Path(os.path.relpath(path, self._root)).as_posix()

    def path(self, key: str) -> Path:
        """The file of this name."""
        return Path(self._place(key))

    def reaches(self, key: str) -> bool:
        """Whether the file is one that urdfsync may touch: below the output folder, or the configuration's."""
        return self._tree(self._place(key)) is not None

    def read(self, key: str) -> bytes | None:
        """The file's content, None if there is none. Raises OutputError for links, folders, unreadable files."""
        return self.read_path(self._place(key))

    def read_path(self, path: str | os.PathLike[str]) -> bytes | None:
        """The content of a file, by its absolute path without detours."""
        tree = self._tree(path)
        return tree.read(path) if tree else None

    def found(self, key: str, role: Role) -> Found:
        """What is there in the place of a file."""
        hashed = self.look(self._place(key))
        if hashed is not None:
            _, own, text = hashed
            return Found(own if role is Role.IMPORT else text)
        return Found(as_folder=self._is_folder(key))

    def unchanged(self, records: Mapping[str, FileRecord]) -> dict[str, FileRecord]:
        """Those of the plain records whose files are just as they say."""
        found: dict[str, FileRecord] = {}
        for folder, entries in itertools.groupby(records.items(), lambda entry: entry[0].rpartition("/")[0]):
            found.update(self._unchanged_in(placed(self._prefix, folder), entries))
        return found

    def _unchanged_in(self, folder: str, entries: Iterable[tuple[str, FileRecord]]) -> Iterator[tuple[str, FileRecord]]:
        """As `unchanged`, for one folder.

        A file keeps its known hash if the system says the same of it as then; else it is looked at.
        """
        is_there = self._home(folder) is not None
        for key, record in entries:
            place = f"{folder}{os.sep}{key.rpartition('/')[2]}"
            hashed = self._known.get(place)
            seen = read_stat(place) if is_there and hashed is not None else None
            if hashed is None or seen is None or stat_of(seen) != hashed[0]:
                hashed = self.look(place)
            else:
                self.hashed.setdefault(place, hashed)
            if hashed is not None and record.base == (hashed[1] if record.role is Role.IMPORT else hashed[2]):
                yield key, record

    def _is_folder(self, key: str) -> bool:
        """Whether the class of a file that is not there has a folder of its own."""
        if not key.endswith(".mo") or key.endswith("/package.mo"):
            return False
        place = self._place(key)
        tree = self._tree(place)
        if tree is not None and not tree.check_folder(place.rpartition(os.sep)[0]):
            return False
        return is_file(f"{place.removesuffix('.mo')}{os.sep}package.mo")

    def text(self, key: str) -> str | None:
        """The file as text; bytes that are not UTF-8 survive, see `encode`."""
        content = self.read(key)
        hashed = None if content is None else (NO_STAT, digest(content), text_digest(content))
        self.hashed.setdefault(self._place(key), hashed)
        return None if content is None else content.decode(errors="surrogateescape")

    def seen(self, key: str) -> str | None:
        """SHA-256 (hex) of what `found` or `text` first saw in the place of a file; None if that was no file."""
        hashed = self.hashed[self._place(key)]
        return None if hashed is None else hashed[1]

    def has_returns(self, key: str) -> bool:
        """Whether there are carriage returns in the file that `found` or `text` first saw; it need not be read."""
        hashed = self.hashed[self._place(key)]
        return hashed is not None and hashed[1] != hashed[2]

    def has_classes(self, key: str, gone: Collection[str]) -> bool:
        """Whether the folder of a `package.mo` has other classes than it, and than those of the files in `gone`."""
        folder = self.path(key).parent
        for path in map(folder.joinpath, list_folder(folder)):
            single = path.suffix == ".mo" and path.name != "package.mo" and is_file(path)
            whole = path / "package.mo"
            if single and self.key(path) not in gone:
                return True
            if not single and is_file(whole) and self.key(whole) not in gone:
                return True
        return False

    def classes(self, folder: str) -> set[str]:
        """All Modelica files of the package in a folder, its own and others, as far as they can be looked at."""
        return {self.key(Path(path)) for path in modelica_files(self.path(folder))}

    def any_text(self, key: str) -> str:
        """The text of a file that is only searched: empty if it can't be read, since it may be the user's own."""
        try:
            return self.text(key) or ""
        except OutputError:
            return ""

    def users_files(self, folders: Iterable[str]) -> dict[Path, bytes]:
        """The Modelica files below the output folder that have to do with the package in one of these folders.

        They are outside of the folders, and known by their paths. What can't be read is left out.
        """
        packages, found = {self.path(folder) for folder in folders}, {}
        for path in map(Path, modelica_files(self._output)):
            if packages.isdisjoint(path.parents):
                with contextlib.suppress(OSError):
                    found[path] = read_file(path)
        return related(found, [package.name for package in packages])

    def look(self, place: str) -> Hashed | None:
        """What is at an absolute path without detours; None for nothing. Raises OutputError as `read`."""
        tree, hashed = self._home(place.rpartition(os.sep)[0]), None
        if tree and (status := tree.status(place)):
            facts, hashed = stat_of(status), self._known.get(place)
            if hashed is None or hashed[0] != facts:
                hashed = self._hashed(tree, place, facts)
        self.hashed.setdefault(place, hashed)
        return hashed

    def _home(self, folder: str) -> Tree | None:
        """The tree that a folder is in; None if it is in none, or not there. Raises OutputError as `Tree`."""
        if folder not in self._homes:
            tree = self._tree(os.path.join(folder, ""))  # noqa: PTH118 - a string
            self._homes[folder] = tree if tree and tree.check_folder(folder) else None
        return self._homes[folder]

    def _hashed(self, tree: Tree, place: str, facts: Stat) -> Hashed | None:
        content = tree.content(place)
        if content is None:
            return None
        own = digest(content)
        return facts, own, text_digest(content) if b"\r" in content else own

    def _place(self, key: str) -> str:
        return placed(self._prefix, key)

    def _tree(self, path: str | os.PathLike[str]) -> Tree | None:
        for tree in self._trees:
            if tree.covers(path):
                return tree
        return None


def encode(text: str) -> bytes:
    """The bytes of a text that `Disk.text` gave, or of a changed one."""
    return text.encode(errors="surrogateescape")
