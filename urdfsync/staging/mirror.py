"""A folder that looks as if the working tree held what is staged, for builds that read it.

It has the path from the root of the file system down to the repository in it, so that whatever is found by
a path from a source to places around it, inside or outside of the repository, is found here too. Folders on that way
are made, and everything beside it is a link to the real thing: nothing is copied but outputs, which must not be links.
Nor are they hard links: these would change a time of the user's files, by which git would read them all again.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import TracebackType
from typing import Self

import msgspec

from urdfsync.config import Config
from urdfsync.diagnostics import Diagnostic
from urdfsync.outcome import Result
from urdfsync.staging.staged import Index


class Mirror:
    """A temporary folder with staged files in their places; it is gone at the end of a `with` statement."""

    def __init__(self, index: Index) -> None:
        self._index = index
        self._keeper = contextlib.ExitStack()
        self._scratch = Path()
        self._own: set[Path] = set()
        """Folders that have been made, by the real path."""
        self._bare: set[Path] = set()
        """Those of them in which nothing is but what is staged."""

    def __enter__(self) -> Self:
        folder = self._keeper.enter_context(tempfile.TemporaryDirectory(prefix="urdfsync-"))
        self._scratch = Path(os.path.realpath(folder))
        self._open(self._index.top)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._keeper.close()

    def place(self, path: Path) -> Path:
        """Where something of the repository is here, by its absolute path."""
        return self._scratch / path.relative_to(path.anchor)

    def real(self, path: Path) -> Path:
        """What a place here stands for; a path that does not lead here is real."""
        inside = path.is_relative_to(self._scratch)
        return Path(self._index.top.anchor) / path.relative_to(self._scratch) if inside else path

    def bring(self, paths: Iterable[str]) -> None:
        """Give staged files their places, as files, not as links; what is not staged is gone from its place."""
        index, changed = self._index, []
        for path in paths:
            self._clear(index.top / path)
            if index.is_submodule(path) or (index.tracks(path) and path not in index.changed):
                self._copy(index.top / path)
            elif index.tracks(path):
                changed.append(path)
        index.checkout(changed, self.place(index.top))

    def bring_folder(self, folder: str) -> None:
        """Give a folder its place with all that is staged below it, and nothing else."""
        self._clear(self._index.top / folder)
        self._bare.add(self._index.top / folder)
        self.bring(self._index.below(folder))

    def config(self, config: Config) -> Config:
        """A configuration that was read here, with its real paths."""
        robots = (
            msgspec.structs.replace(
                robot,
                source=self.real(robot.source),
                output=self.real(robot.output),
                templates=self.real(robot.templates) if robot.templates else None,
                package_paths=tuple(map(self.real, robot.package_paths)),
            )
            for robot in config.robots
        )
        return Config(self.real(config.file), tuple(robots))

    def result(self, result: Result) -> Result:
        """What a build found here, said of the real files."""
        found = tuple(map(self.diagnostic, result.diagnostics))
        root, folder = self.real(result.root), self.real(result.folder)
        return msgspec.structs.replace(result, root=root, folder=folder, diagnostics=found)

    def diagnostic(self, found: Diagnostic) -> Diagnostic:
        """A finding about files here, said of the real ones."""
        message, file, hint = map(self._said, (found.message, found.file, found.hint))
        return msgspec.structs.replace(found, message=message, file=file, hint=hint)

    def _said(self, text: str) -> str:
        here = Path.cwd()
        text = text.replace(f"{self.place(here)}{os.sep}", "")
        return text.replace(f"{self._scratch}{os.sep}", here.anchor)

    def _open(self, folder: Path) -> None:
        """Make a folder, in which everything is a link to the real thing, unless it has been made."""
        if folder in self._own:
            return
        place = self.place(folder)
        if folder != folder.parent:
            self._open(folder.parent)
            if place.is_symlink():
                place.unlink()
            place.mkdir(exist_ok=True)
        self._own.add(folder)
        if self._bare.isdisjoint((folder, *folder.parents)):
            self._link(folder, place)

    def _link(self, folder: Path, place: Path) -> None:
        for entry in _entries(folder):
            if Path(entry.path) not in (self._index.top / ".git", self._scratch):
                # a link that stays in the repository has to stay in here, too
                (place / entry.name).symlink_to(Path(entry).readlink() if entry.is_symlink() else entry.path)

    def _clear(self, path: Path) -> None:
        """Make room for a file or folder of our own."""
        self._open(path.parent)
        place = self.place(path)
        if place.is_symlink() or place.is_file():
            place.unlink()
        elif place.is_dir():
            shutil.rmtree(place)
            self._own = {folder for folder in self._own if path != folder and path not in folder.parents}

    def _copy(self, path: Path) -> None:
        place = self.place(path)
        if path.is_dir() and not path.is_symlink():  # a submodule: as it is on disk
            place.symlink_to(path)
        else:
            shutil.copyfile(path, place, follow_symlinks=False)


def _entries(folder: Path) -> Iterator[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as found:
            yield from found
    except (PermissionError, FileNotFoundError):
        return  # a folder above the repository that only lets us pass, or one that exists in the index only
