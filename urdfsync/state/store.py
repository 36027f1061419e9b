"""`.urdfsync/` on disk: where the record and the bases of each robot are, and how they get there."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

from urdfsync.config import STATE_FOLDER, is_robot_name
from urdfsync.dependencies import list_folder, walk_files
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.files import Tree, digest, normalised, shown
from urdfsync.state import bases, expansion, planned, statefile
from urdfsync.state.expansion import Expansion
from urdfsync.state.planned import PlannedFile
from urdfsync.state.record import Record
from urdfsync.state.transaction import FileChange

SUFFIX, EXPANDED = ".state", ".expanded"
CONFLICTS, REPLACED = "conflicts", "replaced"
"""Folders beside the records, with one for each robot: versions of what conflicts, and what stood in files that the
last build wrote over."""
_FOR_GIT = {
    ".gitignore": """\
# Written by urdfsync. robots/ and bases/ belong into version control, everything else is safe to lose.
/*
!/.gitignore
!/.gitattributes
!/robots/
!/bases/
""",
    ".gitattributes": """\
# Written by urdfsync. Lines of recorded states and bases stand alone: git unites those of two branches.
/robots/*.state merge=union
/robots/*.expanded merge=union
/bases/** merge=union -diff -text linguist-generated
""",
}

Witness: TypeAlias = Mapping[Path, str | None]
"""Files of the state, and the hashes of their bytes when they were loaded; None for a file that was not there."""


class Store:
    """The state folder of one configuration, as one build sees it."""

    def __init__(self, root: Path) -> None:
        self.folder = root / STATE_FOLDER
        self._tree = Tree(root)
        self._seen: dict[Path, tuple[bytes | None, str | None]] = {}
        """Content and hash of each file that was loaded; None for no file."""
        self._bases: dict[Path, dict[str, str]] = {}
        """What was loaded of bases, by their files."""

    def names(self) -> list[str]:
        """The robots that have a record, by their names."""
        try:
            files = list_folder(self.folder / "robots")
        except OSError:  # there is none; that it can't be read is what `load` says
            return []
        return sorted(filter(is_robot_name, (name.removesuffix(SUFFIX) for name in files if name.endswith(SUFFIX))))

    def load(self, robot: str, *, strict: bool = True) -> Record | None:
        """The robot's record, None if it was never built. Raises StateError or OutputError if it can't be used.

        Unless `strict`, what can't be read of it is passed over.
        """
        path = self.path(robot)
        content = self._bytes(path)
        if content is None:
            return None
        try:
            text = content.decode(errors="strict" if strict else "replace")
        except UnicodeDecodeError:
            message, hint = "the recorded state can't be read: it is not UTF-8", "restore it from version control"
            found = Diagnostic(Severity.ERROR, "broken-state", message, shown(path), hint=hint)
            raise StateError(found) from None
        try:
            return statefile.loads(text.replace("\r\n", "\n"), shown(path), strict=strict)
        except StateError as error:
            if strict or any(found.code == "newer-state" for found in error.diagnostics):
                raise
            return None

    def load_expansion(self, robot: str) -> Expansion | None:
        """The robot's source as it was expanded last; None if it never was, or if that is lost."""
        content = self._bytes(self.expansion(robot))
        return None if content is None else expansion.loads(content)

    def planned_files(self) -> tuple[PlannedFile, ...]:
        """What builds that are not complete were about to write, in their order. Raises OutputError for a link."""
        path = self.folder / planned.FILE
        build = planned.parse(path, self._bytes(path))
        return tuple(file for one in build.overtaken() for file in one.files) if build else ()

    def witness(self) -> Witness:
        """What all files were when they were loaded."""
        return {path: sha256 for path, (_, sha256) in self._seen.items()}

    def is_unchanged(self, witness: Witness, but: Collection[Path] = ()) -> bool:
        """Whether all files still are as they were then, but for some that somebody else looks at."""
        tree = Tree(self._tree.root)  # which finds folders that have come since
        found = ((tree.read(path), before) for path, before in witness.items() if path not in but)
        return all((None if content is None else digest(content)) == before for content, before in found)

    def base(self, robot: str, sha256: str) -> str | None:
        """The text with this hash (see `text_digest`) that was generated last for a robot; None if it is lost."""
        return self.bases(robot, sha256[0]).get(sha256) if sha256 else None

    def bases(self, robot: str, digit: str) -> dict[str, str]:
        """The texts generated last for a robot whose hashes begin with a digit, by these hashes."""
        path = self._base_file(robot, digit)
        if path not in self._bases:
            self._bases[path] = bases.loads(self._bytes(path) or b"")
        return self._bases[path]

    def missing_bases(self, robot: str) -> set[str]:
        """The digits for which there is no file of bases."""
        folder = self.folder / "bases" / robot
        return {*bases.DIGITS}.difference(list_folder(folder) if self._tree.check_folder(folder) else ())

    def save_bases(self, robot: str, digit: str, texts: Mapping[str, str] | None) -> list[FileChange]:
        """How the texts of one digit get to the disk, or how their file goes."""
        path, content = self._base_file(robot, digit), None if texts is None else bases.dumps(texts)
        return [self._change(path, content)] if self._bytes(path) != content else []

    def base_files(self, robot: str) -> list[Path]:
        """The files of a robot's bases."""
        return [self._base_file(robot, digit) for digit in bases.DIGITS]

    def _base_file(self, robot: str, digit: str) -> Path:
        return self.folder / "bases" / robot / digit

    def contents(self, kind: str, robot: str) -> dict[str, bytes]:
        """What is in the robot's folder of one kind, by the paths below it. Safe to lose."""
        folder = self.folder / kind / robot
        found = ((path.relative_to(folder).as_posix(), self._bytes(path)) for path in self._files(folder))
        return {path: content for path, content in found if content is not None}

    def fill(self, kind: str, robot: str, contents: Mapping[str, bytes], former: str | None) -> list[FileChange]:
        """How files get to the robot's folder of one kind, by their path below it, and how all others go."""
        folder = self.folder / kind / robot
        folders = [folder, *([folder.with_name(former)] if former else [])]
        there = [path for one in folders for path in self._files(one)]
        wanted = {folder / path: content for path, content in contents.items()}
        gone = [self._change(path, None) for path in there if path not in wanted and self._bytes(path) is not None]
        return gone + [self._change(path, text) for path, text in wanted.items() if self._bytes(path) != text]

    def _files(self, folder: Path) -> list[Path]:
        """All files below a folder. Raises OutputError for a link to it, which may lead to all of the disk."""
        return sorted(map(Path, walk_files(folder))) if self._tree.check_folder(folder) else []

    def changes(self, robot: str, record: Record | None, former: str | None) -> Iterator[FileChange]:
        """How the new record gets to the disk, or how the old one goes if there is none.

        `former` is the robot's name in the record that was loaded.
        """
        path, content = self.path(robot), statefile.dumps(record).encode() if record else None
        drawing = self._drawing(robot)
        for name in (*([robot] if record is None else []), *([former] if former else [])):
            yield from self.save_expansion(name, None)
        if record is None and self._bytes(drawing) is not None:
            yield self._change(drawing, None)
        old = self._bytes(path)
        if content != (old.replace(b"\r\n", b"\n") if old and b"\r" in old else old):
            yield self._change(path, content)
        if former and self._bytes(self.path(former)) is not None:
            yield self._change(self.path(former), None)

    def for_git(self) -> list[FileChange]:
        """How git is told what is safe to lose and how states merge; lines of the user's stay."""
        found = []
        for name, text in _FOR_GIT.items():
            path = self.folder / name
            old = self._bytes(path)
            if old is None:
                found.append(self._change(path, text.encode()))
                continue
            known = {line.strip() for line in old.splitlines()}
            lines = [line for line in text.encode().splitlines() if line[:1] != b"#" and line not in known]
            if lines:
                old += b"" if old.endswith(b"\n") or not old else b"\n"
                found.append(self._change(path, old + b"".join(b"%s\n" % line for line in lines)))
        return found

    def drawing(self, robot: str, text: str) -> tuple[Path, list[FileChange]]:
        """Where the robot's diagram goes, and how it gets there."""
        path = self._drawing(robot)
        return path, [self._change(path, text.encode())] if self._bytes(path) != text.encode() else []

    def _drawing(self, robot: str) -> Path:
        return self.folder / "svg" / f"{robot}.svg"

    def path(self, robot: str) -> Path:
        """The file of the robot's record."""
        return self.folder / "robots" / f"{robot}{SUFFIX}"

    def expansion(self, robot: str) -> Path:
        """The file of the robot's expanded source."""
        return self.folder / "robots" / f"{robot}{EXPANDED}"

    def save_expansion(self, robot: str, found: Expansion | None) -> list[FileChange]:
        """How the expanded source of a robot gets to the disk, or how it goes if there is none."""
        path, content = self.expansion(robot), expansion.dumps(found) if found else None
        old = self._bytes(path)
        return [self._change(path, content)] if content != (old and normalised(old)) else []

    def _change(self, path: Path, content: bytes | None) -> FileChange:
        return FileChange(path, content, self._seen[path][1] if path in self._seen else None)

    def _bytes(self, path: Path) -> bytes | None:
        if path not in self._seen:
            content = self._tree.read(path)
            self._seen[path] = content, None if content is None else digest(content)
        return self._seen[path][0]
