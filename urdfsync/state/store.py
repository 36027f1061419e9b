"""`.urdfsync/` on disk: where the record and the bases of each robot are, and how they get there."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.config import STATE_FOLDER, is_robot_name
from urdfsync.dependencies import list_folder, walk_files
from urdfsync.diagnostics import Diagnostic
from urdfsync.files import Tree, digest, normalised, shown
from urdfsync.state import bases, expansion, notes, statefile
from urdfsync.state.expansion import Expansion
from urdfsync.state.notes import Notes
from urdfsync.state.record import Record
from urdfsync.state.transaction import FileChange

SUFFIX = ".state"
_FOR_GIT = {
    ".gitignore": """\
# Written by urdfsync. robots/, bases/ and schema.json belong into version control, everything else is safe to lose.
/*
!/.gitignore
!/.gitattributes
!/schema.json
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

StateHashes: TypeAlias = Mapping[Path, str | None]
"""Files of the state, and the hashes of their bytes when they were loaded; None for a file that was not there."""


class Aside(msgspec.Struct, frozen=True, omit_defaults=True):
    """One text that was on disk before a build or a choice; it is a plain file below `.urdfsync/aside/`."""

    file: str
    """Its path below the robot's folder there."""
    after: str | None = None
    """Hash of what was written; None if the file was deleted."""
    bases: tuple[str, ...] = ()
    """Hashes of what the text is an edit of, once it is given back."""
    texts: Mapping[str, str] = {}
    """The texts of these bases that are known, by hash."""
    beside: Mapping[str, str] = {}
    """The texts of models that nobody edited and that went with it, by path below the package."""


class Store:
    """The state folder of one configuration, as one build sees it."""

    def __init__(self, root: Path) -> None:
        self.folder = root / STATE_FOLDER
        self._tree = Tree(root)
        self._contents: dict[Path, bytes | None] = {}
        """Of each file that was loaded; None for no file."""
        self._notes: dict[str, Notes] = {}

    def names(self) -> list[str]:
        """The robots that have a record, by their names."""
        try:
            files = list_folder(self.folder / "robots")
        except OSError:  # there is none; that it can't be read is what `load` says
            return []
        return sorted(filter(is_robot_name, (name.removesuffix(SUFFIX) for name in files if name.endswith(SUFFIX))))

    def load(self, robot: str) -> tuple[Record | None, Diagnostic | None]:
        """Return the robot's record, None if there is none that can be read, and a warning if it is damaged.

        Raises StateError for one that a newer urdfsync wrote, OutputError for a link or a folder in its place.
        """
        path = self.path(robot)
        content = self._bytes(path)
        if content is None:
            return None, None
        return statefile.loads(content.decode(errors="replace").replace("\r\n", "\n"), shown(path))

    def load_expansion(self, robot: str) -> Expansion | None:
        """The robot's source as it was expanded last; None if it never was, or if that is lost."""
        content = self._bytes(self.expansion(robot))
        return None if content is None else expansion.loads(content)

    def notes(self, robot: str) -> Notes:
        """Return what this machine has noted of its work on a robot."""
        if robot not in self._notes:
            self._notes[robot] = notes.load(self.folder, robot)
        return self._notes[robot]

    def base(self, robot: str, sha256: str) -> str | None:
        """The text with this hash (see `text_digest`) that was generated once for a robot; None if it is lost."""
        return (self.bases(robot, sha256[0]) or {}).get(sha256)

    def bases(self, robot: str, digit: str) -> Mapping[str, str] | None:
        """The texts generated for a robot whose hashes begin with a digit, by these hashes; None for no file."""
        content = self._bytes(self.base_file(robot, digit))
        return None if content is None else bases.loads(content)

    def find_damaged_base(self, robot: str) -> Diagnostic | None:
        """Return a warning of the first line in the bases that can't be read."""
        for file in self.base_files(robot):
            if line := bases.find_damage(self._bytes(file) or b""):
                return statefile.damage(shown(file), line, "it has no text of this hash")
        return None

    def aside(self, robot: str) -> Mapping[str, Aside]:
        """Return what was put aside, by path below the package; nothing if that can't be read."""
        try:
            index = msgspec.json.decode(self._bytes(self.aside_file(robot)) or b"{}", type=dict[str, Aside])
        except (ValueError, RecursionError):  # it may be a stranger's
            return {}
        return {
            path: one for path, one in index.items() if all(map(statefile.is_inside, (path, one.file, *one.beside)))
        }

    def aside_text(self, robot: str, file: str) -> bytes | None:
        """Return a text that was put aside, by its path below the robot's folder."""
        return self._bytes(self.aside_file(robot, file))

    # --- places ---------------------------------------------------------------------------------------------------

    def path(self, robot: str) -> Path:
        """The file of the robot's record."""
        return self.folder / "robots" / f"{robot}{SUFFIX}"

    def expansion(self, robot: str) -> Path:
        """The file of the robot's expanded source."""
        return self.folder / "robots" / f"{robot}.expanded"

    def base_file(self, robot: str, digit: str) -> Path:
        """The file of the robot's bases whose hashes begin with a digit."""
        return self.folder / "bases" / robot / digit

    def base_files(self, robot: str) -> list[Path]:
        """The files of a robot's bases."""
        return [self.base_file(robot, digit) for digit in bases.DIGITS]

    def aside_file(self, robot: str, path: str = "index.json") -> Path:
        """Return the file of a text that was put aside, by path below the package; or the list of them."""
        return self.folder / "aside" / robot / path

    def drawing(self, robot: str) -> Path:
        """The file of the robot's diagram. Safe to lose."""
        return self.folder / "svg" / f"{robot}.svg"

    def conflicts(self, robot: str) -> Path:
        """The folder with versions of what conflicts. Safe to lose."""
        return self.folder / "conflicts" / robot

    # --- changes --------------------------------------------------------------------------------------------------

    def save(self, path: Path, content: bytes | None) -> list[FileChange]:
        """How a file gets its content, or how it goes for None; nothing if it has that, line ends apart."""
        old = self._bytes(path)
        if content == old or (old is not None and content == normalised(old)):
            return []
        return [FileChange(path, content, None if old is None else digest(old))]

    def save_aside(self, robot: str, index: Mapping[str, Aside], new: Mapping[str, bytes]) -> list[FileChange]:
        """Return the writes for all that is put aside; `new` are texts by file. No text is ever deleted."""
        changes = [change for file, text in new.items() for change in self.save(self.aside_file(robot, file), text)]
        listed = msgspec.json.encode(index, order="sorted") if index else None
        return changes + self.save(self.aside_file(robot), listed)

    def conflict_files(self, robot: str) -> dict[str, bytes]:
        """Return the versions of conflicts on disk, by path below the robot's folder."""
        folder = self.conflicts(robot)
        # raises OutputError for a link to the folder, which may lead to all of the disk
        existing = map(Path, walk_files(folder)) if self._tree.check_folder(folder) else ()
        return {path.relative_to(folder).as_posix(): self._bytes(path) or b"" for path in existing}

    def persons_proposals(self, robot: str, noted: Mapping[str, tuple[str, str]]) -> set[str]:
        """Return the proposed merges that are not as urdfsync has `noted` them, by path: a person changed them.

        A blank one has nothing of a person's, and can't be edited further.
        """
        proposals = {path: text for path, text in self.conflict_files(robot).items() if ".merge" in path}
        return {path for path, text in proposals.items() if text.strip() and digest(text) != noted.get(path, ("",))[0]}

    def save_conflicts(self, robot: str, contents: Mapping[str, bytes], kept: Collection[str] = ()) -> list[FileChange]:
        """Return the writes that bring versions to the robot's folder, by path; all others go, but those `kept`."""
        folder = self.conflicts(robot)
        wanted = dict.fromkeys(sorted(self.conflict_files(robot).keys() - set(kept))) | dict(contents)
        return [change for path, content in wanted.items() for change in self.save(folder / path, content)]

    def remove(self, robot: str) -> list[FileChange]:
        """Return how all goes that was recorded of a robot; texts that are a person's stay."""
        files = (*self.base_files(robot), self.drawing(robot), self.expansion(robot), notes.place(self.folder, robot))
        persons = self.persons_proposals(robot, self.notes(robot).proposals)
        changes = [change for path in (*files, self.path(robot)) for change in self.save(path, None)]
        return [*self.save_conflicts(robot, {}, persons), *changes]

    def for_git(self) -> list[FileChange]:
        """How git is told what is safe to lose and how states merge; what the user has made of these files stays."""
        files = {self.folder / name: text.encode() for name, text in _FOR_GIT.items()}
        missing = {path: content for path, content in files.items() if self._bytes(path) is None}
        return [change for path, content in missing.items() for change in self.save(path, content)]

    def hashes(self) -> StateHashes:
        """The hashes of all files that were loaded, but for bases.

        To hash these takes 20 ms with 1,000 links, and a transaction looks at those that it replaces.
        """
        loaded, below = self._contents.items(), self.folder / "bases"
        files = ((path, content) for path, content in loaded if below not in path.parents)
        return {path: None if content is None else digest(content) for path, content in files}

    def is_unchanged(self, hashes: StateHashes) -> bool:
        """Whether all files still are as they were then."""
        tree = Tree(self._tree.root)  # which finds folders that have come since
        contents = ((tree.read(path), before) for path, before in hashes.items())
        return all((None if content is None else digest(content)) == before for content, before in contents)

    def _bytes(self, path: Path) -> bytes | None:
        if path not in self._contents:
            self._contents[path] = self._tree.read(path)
        return self._contents[path]
