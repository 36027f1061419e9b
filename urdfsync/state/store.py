"""`.urdfsync/` on disk: where the state of each robot is, and how it gets there."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.config import STATE_FOLDER, is_robot_name
from urdfsync.dependencies import list_folder, mark_incomplete
from urdfsync.diagnostics import Diagnostic, OutputError, Severity, StateError
from urdfsync.files import TEMPORARY, Tree, digest, failure, shown, text_digest
from urdfsync.state import file_operations, manifest, modelfile
from urdfsync.state.bases import BaseStore
from urdfsync.state.manifest import Manifest
from urdfsync.state.modelfile import Model
from urdfsync.state.transaction import FileChange

_IGNORE = """\
# Written by urdfsync. robots/ belongs into version control, everything else is safe to lose.
/*
!/.gitignore
!/robots/
"""

_FOLDERS = "folders.json"


class _WrittenFolders(file_operations.Bound, frozen=True):
    """A file that says where builds in this checkout wrote, by robot."""

    folders: dict[str, tuple[str, ...]]


Witness: TypeAlias = Mapping[Path, str | None]
"""Files of the state, and the hashes of their bytes when they were loaded; None for a file that was not there."""


class State(msgspec.Struct, frozen=True):
    """What the last build recorded of a robot."""

    manifest: Manifest
    model: Model | None
    """None if its file is lost."""
    intact: bool
    """Whether manifest and model were written together."""


class Store:
    """The state folder of one configuration, as one build sees it."""

    def __init__(self, root: Path) -> None:
        self.folder = root / STATE_FOLDER
        self._tree = Tree(root)
        self._seen: dict[Path, tuple[bytes | None, str | None]] = {}
        """Content and hash of each file that was loaded; None for no file."""

    def names(self) -> list[str]:
        """The robots that have a state, by their names."""
        try:
            files = list_folder(self.folder / "robots")
        except OSError:  # there is none; that it can't be read is what `load` says
            return []
        names = (name.removesuffix(".toml") for name in files if name.endswith(".toml"))
        return sorted(filter(is_robot_name, names))

    def load(self, robot: str) -> State | None:
        """The robot's state, None if it was never built. Raises StateError or OutputError if it can't be used."""
        path, beside = self.paths(robot)
        text = self._read(path)
        if text is None:
            return None
        recorded = manifest.loads(text, shown(path))
        content = self._read(beside)
        if content is None:
            return State(recorded, None, intact=False)
        model = modelfile.loads(content, shown(beside))
        return State(recorded, model, intact=text_digest(content.encode()) == recorded.source.snapshot)

    def texts(self, robot: str) -> tuple[str | None, str | None]:
        """The text of the robot's manifest and of its model, whatever they are; None for what is not there."""
        contents = map(self._bytes, self.paths(robot))
        manifest_text, model_text = (None if c is None else c.decode(errors="replace") for c in contents)
        return manifest_text, model_text

    def witness(self) -> Witness:
        """What all files were when they were loaded."""
        return {path: sha256 for path, (_, sha256) in self._seen.items()}

    def is_unchanged(self, witness: Witness, but: Collection[Path] = ()) -> bool:
        """Whether all files still are as they were then, but for some that somebody else looks at."""
        tree = Tree(self._tree.root)  # which finds folders that have come since
        found = ((tree.read(path), before) for path, before in witness.items() if path not in but)
        return all((None if content is None else digest(content)) == before for content, before in found)

    def written_folders(self, robot: str) -> frozenset[str]:
        """The keys of the folders that hold the robot's package, by what builds in this checkout noted.

        A manifest may come from somebody else, together with the hashes of files that are the user's own. So what it
        says of other folders than the configured one counts only if this says the same.
        """
        return frozenset(self._noted_folders().get(robot, ()))

    def note_folders(self, robot: str, folders: Collection[str], former: str | None = None) -> None:
        """Note which folders hold a robot's package; `former` is a name of the robot that is no more.

        Raises OutputError. For the holder of the build lock only.
        """
        noted = self._noted_folders()
        new = {name: paths for name, paths in noted.items() if name != former} | {robot: tuple(sorted(folders))}
        if new == noted:
            return
        file = self.folder / _FOLDERS
        temporary = file.with_name(f".{_FOLDERS}{TEMPORARY}")
        Tree(self._tree.root).check_folder(self.folder)
        try:
            file_operations.make_folder(self.folder)
            file_operations.remove(temporary)  # of a build that was killed here
            file_operations.write_bound(temporary, _WrittenFolders(new))
            file_operations.replace(temporary, file)
        except OSError as error:
            raise failure(error, file) from None

    def _noted_folders(self) -> Mapping[str, tuple[str, ...]]:
        """The packages' folders by robot; empty if the file is not there, or was not written in this checkout."""
        file = self.folder / _FOLDERS
        try:
            content = Tree(self._tree.root).read(file)  # finds a folder that this build has made
            noted = msgspec.json.decode(content or b"", type=_WrittenFolders)
            return noted.folders if file_operations.is_bound(file, noted) else {}
        except (OSError, OutputError, msgspec.DecodeError, UnicodeDecodeError, RecursionError):
            return {}

    def bases(self, robot: str) -> BaseStore:
        """The texts that were written last, as far as they are kept."""
        return BaseStore(self.folder / "base" / robot)

    def conflicts(self, robot: str, contents: Mapping[str, bytes], former: str | None) -> list[FileChange]:
        """How files get to the robot's folder of conflicts, by their path below it, and how all others go."""
        folder = self.folder / "conflicts" / robot
        folders = [folder, *([folder.with_name(former)] if former else [])]
        known = [one for one in folders if self._tree.check_folder(one)]  # a link may lead to all of the disk
        if known:
            mark_incomplete()  # what is in there is not recorded as a dependency
        there = sorted(path for one in known for path in one.rglob("*") if not path.is_dir())
        wanted = {folder / path: content for path, content in contents.items()}
        gone = [self._change(path, None) for path in there if path not in wanted and self._bytes(path) is not None]
        return gone + [self._change(path, text) for path, text in wanted.items() if self._bytes(path) != text]

    def changes(self, robot: str, recorded: str, model: str | None, former: str | None) -> Iterator[FileChange]:
        """How the new state gets to the disk, the manifest last; `model` is None if it stays.

        `former` is the name that the robot had in the state that was loaded, if it has another one now.
        """
        path, beside = self.paths(robot)
        for file, text in ((beside, model), (path, recorded)):
            old, content = self._bytes(file) or b"", None if text is None else text.encode()
            if content is not None and content != (old.replace(b"\r\n", b"\n") if b"\r" in old else old):
                yield self._change(file, content)
        for file in self.paths(former) if former else ():
            if self._bytes(file) is not None:
                yield self._change(file, None)

    def ignoring(self) -> list[FileChange]:
        """How version control is told what is safe to lose, unless it has been told already."""
        ignore = self.folder / ".gitignore"
        return [self._change(ignore, _IGNORE.encode())] if self._bytes(ignore) is None else []

    def drawing(self, robot: str, text: str) -> tuple[Path, list[FileChange]]:
        """Where the robot's diagram goes, and how it gets there."""
        path = self.folder / "svg" / f"{robot}.svg"
        return path, [self._change(path, text.encode())] if self._bytes(path) != text.encode() else []

    def paths(self, robot: str) -> tuple[Path, Path]:
        """The robot's manifest, and its model."""
        folder = self.folder / "robots"
        return folder / f"{robot}.toml", folder / f"{robot}.json"

    def _change(self, path: Path, content: bytes | None) -> FileChange:
        return FileChange(path, content, self._seen[path][1] if path in self._seen else None)

    def _bytes(self, path: Path) -> bytes | None:
        if path not in self._seen:
            content = self._tree.read(path)
            self._seen[path] = content, None if content is None else digest(content)
        return self._seen[path][0]

    def _read(self, path: Path) -> str | None:
        content = self._bytes(path)
        try:
            return None if content is None else content.decode().replace("\r\n", "\n")
        except UnicodeDecodeError:
            message, hint = "the recorded state can't be read: it is not UTF-8", "restore it from version control"
            found = Diagnostic(Severity.ERROR, "broken-state", message, shown(path), hint=hint)
            raise StateError(found) from None
