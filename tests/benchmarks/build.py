"""First builds and builds after one change, whole processes, beside the published tool.

The robots of the first two tables are chains that the benchmark makes, read once only (without cross-check, since the
published tool has none), except those that say otherwise. Each link has a mass, a visual and a collision. The robot
with meshes shows what their import takes; the published tool only writes down their names. The third table has robots
as they come, with a cross-check: an example of the library, and of the corpus (see `support.corpus`) the UR5e and the
robot with the most links.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from support import corpus

from benchmarks.builds import changed, changed_by, first, first_by, least
from benchmarks.measuring import Cost, Quantity, measure, run
from benchmarks.robots import chain, mesh, write_meshes, write_workspace
from benchmarks.study import Row, Study
from benchmarks.tools import NOTHING, Tools

ARM = corpus.REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm" / "six_axis_arm.urdf"
UR5E = "universal_robots/ur_description/urdf/ur5e.urdf"
BARS: dict[int, float] = {11: 3.0, 100: 0.8, 1000: 0.02}
"""What a first build may take at most, times the published tool, by the number of links; a UR10e has eleven."""
MANY = 1000
MESHES = "11 links with meshes"
LEAST = {
    "100 links, modules alone": "modules",
    "100 links, modules, Jinja and files": "files",
    "100 links, the package and nothing else": "package",
}
"""What a first build can't do without, and which part of `floor` that is."""

_Found = dict[str, Callable[[], Cost]]


def studies(tools: Tools) -> Iterator[Study]:
    """What is measured."""
    yield _first(tools)
    yield _changed(tools)
    yield _real(tools)


def _first(tools: Tools) -> Study:
    found: _Found = {NOTHING: tools.nothing}
    places = {f"{links:,} links": write_workspace(tools.folder / f"first{links}", 1, links) for links in BARS}
    places[MESHES] = _with_meshes(tools.folder / "meshes")
    for label, place in places.items():
        found[label] = first(tools, place)
        if tools.published:
            found[_theirs(label)] = first_by(tools.published, place / "robot0.urdf", tools.folder / f"by {place.name}")
    for label, part in LEAST.items():
        found[label] = least(tools, write_workspace(tools.folder / f"least {part}", 1, 100), part)
    many = f"{MANY:,} links"
    rows = [
        *(Row(f"{links:,} links", _theirs(f"{links:,} links"), bar) for links, bar in BARS.items()),
        Row(many, _theirs(many), 0.8, Quantity.PEAK),
        *(Row(label, _theirs(label), None, Quantity.CPU) for label in places),
        Row(MESHES, _theirs(MESHES)),
        *(Row(label, _theirs("100 links")) for label in LEAST),
        *(Row(label, _theirs("100 links"), None, Quantity.CPU) for label in LEAST),
        *(Row(label, NOTHING) for label in places),
    ]
    return Study("first build", found, rows, slow={_theirs(many)})


def _changed(tools: Tools) -> Study:
    found: _Found = {NOTHING: tools.nothing}
    for links in BARS:
        place = write_workspace(tools.folder / f"changed{links}", 1, links)
        found[f"{links:,} links"] = changed(tools, place, "robot0")
        if tools.published and links != MANY:
            other = tools.folder / f"update{links}"
            found[_theirs(f"{links:,} links")] = changed_by(tools.published, place / "robot0.urdf", other)
    rows = [
        Row("100 links", _theirs("100 links"), 1.5),
        Row("100 links", _theirs("100 links"), None, Quantity.CPU),
        Row("11 links", _theirs("11 links")),
        *(Row(f"{links:,} links", NOTHING) for links in BARS),
    ]
    return Study("one mass changed, whole process", found, rows)


def _theirs(label: str) -> str:
    return f"published tool, {label}"


def _with_meshes(folder: Path) -> Path:
    write_workspace(folder, 1, 11)
    (folder / "robot0.urdf").write_text(chain("robot0", 11, mesh), encoding="utf-8")
    write_meshes(folder, 11)
    return folder


def _real(tools: Tools) -> Study:
    found: _Found = {NOTHING: tools.nothing}
    for number, (label, source) in enumerate(_robots(tools)):
        found[f"{label}: first build"] = first(tools, _project(tools.folder / f"first real {number}", source))
        place = _project(tools.folder / f"built real {number}", source)
        run(tools.urdfsync("build", "--quiet"), place)
        found[f"{label}: no-op"] = _noop(tools, place)
    return Study("robots as they come", found, [Row(label, NOTHING) for label in found if label != NOTHING])


def _noop(tools: Tools, place: Path) -> Callable[[], Cost]:
    return lambda: measure(tools.urdfsync("build"), place, "in step")


def _project(folder: Path, source: Path) -> Path:
    folder.mkdir()
    configuration = f'[robots.robot]\nsource = "{source.as_posix()}"\npackage = "Robot"\n'
    (folder / "urdfsync.toml").write_text(configuration, encoding="utf-8")
    return folder


def _robots(tools: Tools) -> Iterator[tuple[str, Path]]:
    """Robots by what they are called in the table."""
    yield _labelled("six_axis_arm", ARM)
    found = [corpus.FOLDER / file for file in corpus.robots() if file != corpus.ABSENT]
    if not found:
        tools.say("there is no corpus of robots: set URDFSYNC_CORPUS")
    yield from (_labelled("ur5e", path) for path in found if path.as_posix().endswith(UR5E))
    readable = [path for path in found if _is_built(path)]
    if readable:
        largest = max(readable, key=_links)
        yield _labelled(largest.stem, largest)


def _labelled(name: str, source: Path) -> tuple[str, Path]:
    return f"{name}, {_links(source)} links", source


def _links(source: Path) -> int:
    return source.read_bytes().count(b"<link ")


def _is_built(source: Path) -> bool:
    """Whether a package can be made of it at all."""
    from urdfsync.urdf.parse.source import read_robot

    return read_robot(source.read_bytes(), source.name, cross_check=False).robot is not None
