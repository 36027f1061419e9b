"""The files of one robot's package during one build. A file is hashed once, and read when its text is asked for."""

from __future__ import annotations

import contextlib
import copy
import enum
import os
import time
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from urdfsync.common import files
from urdfsync.common.dependencies import reads
from urdfsync.common.dependencies.facts import NOTHING, is_young
from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import Tree, digest, normalised, placed, relative, shown
from urdfsync.domain import Role
from urdfsync.modelica.stamp import Stamp, split
from urdfsync.project.config import Config, RobotConfig

if TYPE_CHECKING:
    from urdfsync.merge import Merge


class Folder(str):
    """The key of a package's folder. It turns keys of files into paths below the folder, and back."""

    __slots__ = ()

    def key(self, path: str) -> str:
        """Return the key of a file by its path."""
        return f"{self}/{path}"

    def path(self, key: str) -> str:
        """Return the path of a file below the folder by its key; for a file elsewhere, the key itself."""
        return key.removeprefix(f"{self}/")


class ClassFolder(enum.Enum):
    """Stands for the hash of a file if its class is a folder (`X/package.mo`) instead.

    This value is not a string, so no hash in a stranger's record can equal it.
    """

    CLASS_FOLDER = enum.auto()


CLASS_FOLDER = ClassFolder.CLASS_FOLDER
OnDisk: TypeAlias = str | ClassFolder | None
"""Hash of the file at a path; None without a file."""


class FileState(NamedTuple):
    """The hashes of a file when it was read, and its stamp."""

    sha256: str
    """Hash of the bytes, in hex."""
    text_sha256: str
    """Hash of the bare text with line feeds as line endings, in hex."""
    stamp: Stamp | None = None


_unchanged: dict[str, tuple[tuple[int, ...], FileState]] = {}
"""The states and stat values of read files, by absolute path: the daemon reads only files with new stat values.

Serves the rows "one mass changed in the daemon" of docs/speed.md: saves a sixth of the time. Dropping it changes no
byte of the output.
"""


def unchanged_state(path: str, facts: tuple[int, ...]) -> FileState | None:
    """Return the state of a file if its stat values are unchanged; None if the file must be read."""
    known = _unchanged.get(path)
    return known[1] if known and known[0] == facts else None


def note_state(path: str, facts: tuple[int, ...], content: bytes) -> FileState:
    """Return and remember the state of a file that was read; `facts` are the file's stat values before the reading."""
    state = _state_of(content)
    if len(facts) > 1 and not is_young(facts, time.time_ns()):  # for a missing file there is only one fact
        _unchanged[path] = facts, state
    return state


class PackageFiles:
    """The files of one robot's package, by their key: the path from the configuration's folder, POSIX."""

    def __init__(self, config: Config, robot: RobotConfig) -> None:
        self.root = config.root
        self.overlay: Mapping[str, bytes | None] = {}
        """Contents that override the disk, by key: results of choices, and what both branches meant with files that git
        merged. None stands for no file.
        """
        self.left_by_git: Mapping[str, Merge | None] = {}
        """For each file that is still git's merge, by key: the merge of two branches that contradict each other; None
        if the overlay has the meant text.
        """
        self._prefix = os.path.join(os.path.normpath(config.root), "")  # noqa: PTH118 - strings: there are thousands
        # as when writing: below the configuration's folder, the output folder is no link
        self._trees = [Tree(config.root), Tree(robot.output)]
        self._tree_of: dict[str, Tree | None] = {}  # by folder
        self._states: dict[str, FileState | None] = {}
        """State of each file, by absolute path."""
        self._texts: dict[str, str | None] = {}
        """The texts on disk that were read, by key: one build decides and merges by the same text."""
        self._classes: dict[str, frozenset[str]] = {}
        """The Modelica files on disk below each folder that was listed."""

    def laid_over(self, contents: Mapping[str, bytes | None], left_by_git: Mapping[str, Merge | None]) -> PackageFiles:
        """Return the same files with other contents (see `overlay`)."""
        files = copy.copy(self)  # with what was read from the disk
        files.overlay, files.left_by_git = contents, left_by_git
        return files

    def key(self, path: Path) -> str:
        """Return the key of a file."""
        return key_of(path, self.root)

    def path(self, key: str) -> Path:
        """Return the absolute path of a file."""
        return Path(self._place(key))

    def is_inside(self, key: str) -> bool:
        """Return whether urdfsync may touch the file: it is below the output folder or the configuration's folder."""
        return self._tree(self._place(key).rpartition(os.sep)[0]) is not None

    def is_chosen(self, key: str) -> bool:
        """Return whether a choice has made the content of a file."""
        return key in self.overlay and key not in self.left_by_git

    def read(self, key: str) -> bytes | None:
        """Return a file's content; None without a file. Raises OutputError for links, folders, unreadable files."""
        return self.overlay[key] if key in self.overlay else self.read_on_disk(key)

    def read_on_disk(self, key: str) -> bytes | None:
        """Return a file's content on disk. Raises OutputError as `read`."""
        path = self._place(key)
        tree = self._tree(path.rpartition(os.sep)[0])
        return tree.read(path) if tree else None

    def stamp(self, key: str) -> Stamp | None:
        """Return a file's stamp; None without one. Raises OutputError as `read`."""
        state = self.state(key)
        return state.stamp if state else None

    def text(self, key: str) -> str | None:
        """Return a file's bare text. Raises OutputError as `read`, and for other encodings than UTF-8."""
        if key not in self.overlay and key in self._texts:
            return self._texts[key]
        content = self.read(key)
        if key not in self.overlay:
            self._states.setdefault(self._place(key), None if content is None else _state_of(content))
        try:
            text = None if content is None else split(content.decode())[0]
        except UnicodeDecodeError as error:
            line = error.object.count(b"\n", 0, error.start) + 1
            hint, place = "save it as UTF-8, then try again", shown(self.path(key))
            message = "the file is not UTF-8, which Modelica demands"
            raise OutputError.of("no-text", message, place, line, hint=hint) from None
        if key not in self.overlay:
            self._texts[key] = text
        return text

    def any_text(self, key: str) -> str:
        """Return the text of a file, which may be the user's, for a search; empty for an unreadable file."""
        try:
            return self.text(key) or ""
        except OutputError:
            return ""

    def can_read(self, key: str) -> bool:
        """Return whether there is a readable file."""
        try:
            return self.text(key) is not None
        except OutputError:
            return False

    def state(self, key: str) -> FileState | None:
        """Return the state of a file when it was first read; None without a file. Raises OutputError as `read`."""
        if key not in self.overlay:
            return self.state_on_disk(key)
        content = self.overlay[key]
        return None if content is None else _state_of(content)

    def state_on_disk(self, key: str) -> FileState | None:
        """Return the state of a file on disk when it was first read. Raises OutputError as `read`."""
        path = self._place(key)
        if path in self._states:
            return self._states[path]
        folder, state = path.rpartition(os.sep)[0], None
        tree = self._tree(folder)
        if tree is not None and tree.check_folder(folder):
            try:
                facts = reads.read_stat(path)
            except OSError:
                facts = ()  # `read` looks again, and explains the error
            state = unchanged_state(path, facts)
            if state is None and facts != NOTHING and (content := tree.read(path, facts)) is not None:
                state = note_state(path, facts, content)
        self._states[path] = state
        return state

    def hash(self, key: str, role: Role) -> str | None:  # noqa: ARG002 - of files of each role alike
        """Return the hash of a file, whatever its line ends (see `files.text_hash`); None without a file."""
        state = self.state(key)
        return None if state is None else state.text_sha256

    def on_disk(self, key: str, role: Role) -> OnDisk:
        """Return the hash of a file, or CLASS_FOLDER if its class is a folder; None without both."""
        sha256 = self.hash(key, role)
        if sha256 or not key.endswith(".mo") or key.endswith("/package.mo"):
            return sha256
        path = self._place(key)
        folder = path.rpartition(os.sep)[0]
        tree = self._tree(folder)
        if tree is not None and not tree.check_folder(folder):
            return None
        is_class_folder = reads.is_file(f"{path.removesuffix('.mo')}{os.sep}package.mo")
        return CLASS_FOLDER if is_class_folder else None

    def has_classes(self, key: str, gone: Collection[str]) -> bool:
        """Return whether the folder of a `package.mo` holds other classes; the files in `gone` do not count."""
        folder, left = self.path(key).parent, {*gone, *(key for key, text in self.overlay.items() if text is None)}
        for path in map(folder.joinpath, reads.list_folder(folder)):
            package = path / "package.mo"
            if path.suffix == ".mo" and path.name != "package.mo" and reads.is_file(path):
                if self.key(path) not in left:
                    return True
            elif reads.is_file(package) and self.key(package) not in left:
                return True
        return False

    def stamps(self, folder: str) -> dict[str, Stamp]:
        """Return the stamps of the Modelica files below the folder with this key, by key."""
        found = dict[str, Stamp]()
        for key in sorted(self.classes(folder)):
            with contextlib.suppress(OutputError):  # a link of the user's
                if stamp := self.stamp(key):
                    found[key] = stamp
        return found

    def classes(self, folder: str) -> set[str]:
        """Return all Modelica files below the folder with this key, the user's own included."""
        from urdfsync.modelica.files import modelica_files

        folder = folder.removesuffix("/")
        if folder not in self._classes:
            place = str(self.path(folder))  # strings are faster than paths: there are thousands of files
            paths = modelica_files(Path(place))
            self._classes[folder] = frozenset(folder + path[len(place) :].replace(os.sep, "/") for path in paths)
        found = self._classes[folder]
        laid = {key for key in self.overlay if key.startswith(f"{folder}/") and key.endswith(".mo")}
        return {*(found - laid), *(key for key in laid if self.overlay[key] is not None)}

    def has_class(self, folder: str, name: str) -> bool:
        """Return whether a folder has a file or a folder for this class. Unlike `classes`, links count."""
        place, key = self.path(folder), f"{folder.rstrip('/')}/{name}.mo"
        if key in self.overlay:
            return self.overlay[key] is not None
        return reads.is_file(place / f"{name}.mo") or reads.is_folder(place / name)

    def _place(self, key: str) -> str:
        return placed(self._prefix, key)

    def _tree(self, folder: str) -> Tree | None:
        """Return the tree of a folder's files."""
        if folder not in self._tree_of:
            file = os.path.join(folder, "")  # noqa: PTH118 - strings: there are thousands
            self._tree_of[folder] = next((tree for tree in self._trees if tree.covers(file)), None)
        return self._tree_of[folder]


def key_of(path: Path, root: Path) -> str:
    """Return the key of a file; `root` is the configuration's folder."""
    return Path(relative(path, root)).as_posix()


def bare_hash(content: bytes) -> str:
    """Return the hash of the bare text of a file's content."""
    return _state_of(content).text_sha256


def _state_of(content: bytes) -> FileState:
    """Return the state of a file with this content."""
    sha256, stamp = digest(content), None
    if b"__urdfsync" in content:
        text, stamp = split(normalised(content).decode(errors="surrogateescape"))
        return FileState(sha256, text_hash(text), stamp)
    return FileState(sha256, sha256[:16] if normalised(content) is content else files.text_hash(content))


def text_hash(text: str) -> str:
    """Return the hash of a text, ignoring kinds of line ends."""
    return files.text_hash(encode(text))


def encode(text: str) -> bytes:
    """Return the bytes of a text from `PackageFiles.text`, or of a changed text."""
    return text.encode(errors="surrogateescape")


def with_line_ends(generated: bytes, mine: bytes) -> bytes:
    """Return a generated text with the most frequent line end of the file on disk."""
    return generated.replace(b"\n", b"\r\n") if 2 * mine.count(b"\r\n") > mine.count(b"\n") else generated
