"""First builds, and builds after one mass has changed, as the benchmarks measure them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from benchmarks.measuring import Cost, UnexpectedError, measure, run, variables
from benchmarks.published import Published
from benchmarks.robots import Source
from benchmarks.tools import Tools

_FLOOR = Path(__file__).with_name("floor.py")
_MODULES = """
import sys
from urdfsync.__main__ import main
main()
print(*[name for name, module in sys.modules.items() if getattr(module, "__spec__", None)], file=sys.stderr)
"""
"""A command, and then the names of all modules that it has loaded, in their order."""


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


def least(tools: Tools, place: Path, part: str) -> Callable[[], Cost]:
    """A part of what a first build of the only robot of a folder can't do without (see `floor`); this builds it."""
    asked = [str(tools.scripts / "python"), "-c", _MODULES, "build", "--quiet"]
    built = subprocess.run(asked, cwd=place, env=variables(), check=True, stderr=subprocess.PIPE, text=True)
    sizes = _sizes(place / "modelica")
    template, folder, file = place / "least.jinja", place / "least", place / "least.json"
    template.write_text("<< text >>", encoding="utf-8")
    (source,) = place.glob("*.urdf")
    places = {"template": str(template), "folder": str(folder), "source": str(source)}
    file.write_text(json.dumps({"modules": built.stderr.split(), "sizes": sizes, **places}), encoding="utf-8")

    def measurement() -> Cost:
        put_aside(folder)
        os.sync()
        cost = measure([str(tools.scripts / "python"), "-P", str(_FLOOR), part, str(file)], place)
        if part != "modules" and _sizes(folder) != sizes:
            raise UnexpectedError(f"{folder} is not what was built")
        return cost

    return measurement


def _sizes(folder: Path) -> dict[str, int]:
    """The files below a folder, by their paths there, and their sizes."""
    return {file.relative_to(folder).as_posix(): file.stat().st_size for file in folder.rglob("*.*")}


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
