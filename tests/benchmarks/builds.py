"""First builds, and builds after one mass has changed, as the benchmarks measure them."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from benchmarks.measuring import Cost, UnexpectedError, measure, run
from benchmarks.published import Published
from benchmarks.robots import Source
from benchmarks.tools import Tools


def first(tools: Tools, folder: Path, arguments: Sequence[str] = ()) -> Callable[[], Cost]:
    """A build of all robots of a folder, where nothing is built yet."""

    def measurement() -> Cost:
        clear(folder)
        cost = measure(tools.urdfsync("build", *arguments), folder, "files written")
        for robot in folder.glob("*.urdf"):
            package = folder / "modelica" / robot.stem.capitalize()
            if not (package / "package.mo").is_file():
                raise UnexpectedError(f"{package} is not built")
        return cost

    return measurement


def clear(folder: Path) -> None:
    """Take away all that was built in a folder, and leave no writing to be done for that to what is measured next."""
    for name in ("modelica", ".urdfsync"):
        put_aside(folder / name)
    os.sync()


def put_aside(path: Path) -> None:
    """Move a folder away, if it is there. It is not deleted: ext4 makes files slowly where many have just gone."""
    if path.exists():
        aside = Path(tempfile.mkdtemp(prefix="old-", dir=path.parent.parent))
        path.rename(aside / path.name)


def changed(tools: Tools, folder: Path, name: str) -> Callable[[], Cost]:
    """A build after the mass of one link has changed in `<name>.urdf`; the folder is built before."""
    run(tools.urdfsync("build", "--quiet"), folder)
    source = Source(folder / f"{name}.urdf")

    def measurement() -> Cost:
        mass = source.edit()
        os.sync()
        cost = measure(tools.urdfsync("build"), folder, "written")
        records = (folder / "modelica" / name.capitalize() / "Links").glob("*Parameters.mo")
        if not any(f"mass = {mass}," in record.read_text(encoding="utf-8") for record in records):
            raise UnexpectedError(f"no record of {folder} has the mass {mass}")
        return cost

    return measurement


def first_by(published: Published, source: Path, folder: Path) -> Callable[[], Cost]:
    """A first build by the published tool, in a folder for it alone."""

    def measurement() -> Cost:
        put_aside(folder)
        os.sync()
        return published.build(source, folder)

    return measurement


def changed_by(published: Published, original: Path, folder: Path) -> Callable[[], Cost]:
    """An update by the published tool after the mass of one link has changed, in a folder for it alone."""
    folder.mkdir()
    source = Source(Path(shutil.copy(original, folder / original.name)))
    published.build(source.path, folder / "out")

    def measurement() -> Cost:
        mass = source.edit()
        os.sync()
        return published.update(source.path, folder / "out", mass)

    return measurement
