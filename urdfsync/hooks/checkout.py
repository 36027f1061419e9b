"""A folder that looks as if the working tree held what is in the index, for dry builds that read it.

The folder has the path from the root of the file system down to the repository in it, so that each relative path from
a source leads to the same place, inside or outside of the repository. Folders on that way are made; everything beside
it is a link to the real thing. Only outputs, which must not be links, and staged files that differ are files. Hard
links would change a time of the user's files, by which git would read them all again.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

import msgspec

from urdfsync import config as configuration
from urdfsync.config import STATE_FOLDER, Config, RobotConfig
from urdfsync.diagnostics import Diagnostic, UrdfsyncError
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.parents import files as parent_files
from urdfsync.engine.result import Result
from urdfsync.hooks.index import Index
from urdfsync.state.store import Store


class IndexCheckout:
    """The folder, and the staged files that have been checked out into it."""

    def __init__(self, index: Index, scratch: Path) -> None:
        """`scratch` is an empty folder, named by its real path."""
        self._index, self._scratch = index, scratch
        self._link_content(Path(index.top.anchor))
        self._make_folder(index.top)

    def place(self, path: Path) -> Path:
        """Return the path in here of a file of the repository."""
        return self._scratch / path.relative_to(path.anchor)

    def add(self, paths: Iterable[str]) -> None:
        """Check out files, as files and not as links; what is not staged is removed from here."""
        index, staged = self._index, []
        for path in paths:
            file = index.top / path
            self._remove(file)
            if index.is_submodule(path):
                self.place(file).symlink_to(file)  # as it is on disk
            elif index.tracks(path):
                staged.append(path)
        index.checkout(staged, self.place(index.top))

    def add_folder(self, folder: Path) -> None:
        """Check out all that is staged below a folder, and let it hold nothing else."""
        path = self._index.path(folder)
        if path is not None:
            self._remove(self._index.top / path)
            files = [file for file in self._index.below(path) if not self._index.is_submodule(file)]
            self._index.checkout(files, self.place(self._index.top))

    def add_outputs(self, robot: RobotConfig, root: Path) -> None:
        """Check out everything that a build of a robot may write; `root` is the configuration's folder."""
        self.add_folder(robot.folder)
        self.add(self._index.paths(map(Path, parent_files(robot))))
        with contextlib.suppress(UrdfsyncError):  # the build reports it
            state = Store(self.place(root)).load(robot.name)
            if state is not None and root / state.folder != robot.folder:
                self.add_folder(root / state.folder)

    def real_diagnostic(self, found: Diagnostic) -> Diagnostic:
        """Return a finding about files in here, told of the real ones."""
        here = Path.cwd()

        def told(text: str) -> str:
            return text.replace(f"{self.place(here)}{os.sep}", "").replace(f"{self._scratch}{os.sep}", here.anchor)

        return msgspec.structs.replace(found, message=told(found.message), file=told(found.file), hint=told(found.hint))

    def _make_folder(self, folder: Path) -> None:
        """Make a folder in which everything is a link to the real thing, unless it is here already."""
        if folder == folder.parent:
            return
        self._make_folder(folder.parent)  # first, so that the place is in no link
        place = self.place(folder)
        if place.is_symlink() or not place.is_dir():
            place.unlink(missing_ok=True)
            place.mkdir()
            self._link_content(folder)

    def _link_content(self, folder: Path) -> None:
        try:
            paths = list(folder.iterdir())
        except (PermissionError, FileNotFoundError):
            return  # a folder above the repository that may only be passed through, or one that only the index has
        for path in paths:
            if path not in (self._index.top / ".git", self._scratch):
                # a link that stays in the repository has to stay in here, too
                self.place(path).symlink_to(path.readlink() if path.is_symlink() else path)

    def _remove(self, path: Path) -> None:
        """Make room for a file or folder of our own."""
        self._make_folder(path.parent)
        place = self.place(path)
        if place.is_symlink() or place.is_file():
            place.unlink()
        elif place.is_dir():
            shutil.rmtree(place)


@contextlib.contextmanager
def index_checkout(index: Index) -> Iterator[IndexCheckout]:
    """Make a checkout of the index in a temporary folder, which is removed at the end."""
    with tempfile.TemporaryDirectory(prefix="urdfsync-") as folder:
        yield IndexCheckout(index, Path(os.path.realpath(folder)))


def plan_index(
    index: Index, file: Path, options: BuildOptions, names: Collection[str] | None = None
) -> tuple[Config, dict[str, Result]]:
    """Plan builds of the robots of these names, or all, from what is in the index; `options` are those of a dry run.

    Returns the staged configuration and the results by robot, all with real paths. Raises ConfigError.
    """
    with index_checkout(index) as checkout:
        checkout.add(index.changed)
        checkout.add_folder(file.parent / STATE_FOLDER)
        place = checkout.place(file)
        config, here = configuration.load(file, place), configuration.load(place)
        real = {robot.name: robot for robot in config.robots if names is None or robot.name in names}
        robots = []
        for robot in (robot for robot in here.robots if robot.name in real):
            checkout.add_outputs(real[robot.name], config.root)
            # packages that a search from in here does not find, since it does not follow links
            others = tuple(path for path in real[robot.name].package_paths if path not in robot.package_paths)
            robots.append(msgspec.structs.replace(robot, package_paths=robot.package_paths + others))
        results = {}
        for result in build(here, robots, options):
            results[result.robot] = msgspec.structs.replace(
                result,
                root=config.root,
                folder=real[result.robot].folder,
                diagnostics=tuple(map(checkout.real_diagnostic, result.diagnostics)),
            )
        return config, results
