"""Another place where a source's package is found is noticed by each command, in each format, as a clone does."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.meshes import stl
from support.remembered import SHORT, save

from urdfsync.common.dependencies import facts
from urdfsync.common.dependencies.places import Clone
from urdfsync.formats.translation.files import Files, TranslationError

Place = str
"""A folder: of the project, or behind `/` of the test."""

_BEAM = """<link name="beam"><inertial><mass value="{0}"/>
  <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>"""
_HINGE = """<joint name="hinge" type="revolute"><parent link="base"/><child link="beam"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>"""
_SHAPE = '<visual><geometry><mesh filename="{}"/></geometry></visual>'
_XACRO = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{}</robot>'
_PACKAGE = {
    "package.xml": "<package><name>pk</name></package>",
    "package.mo": "",
    "beam.xacro": _XACRO.format(_BEAM),
    "model.config": '<model><sdf version="1.9">model.sdf</sdf></model>',
    "model.sdf": '<sdf version="1.9"><model name="pk"><link name="beam"><inertial><mass>{}</mass></inertial></link>'
    "</model></sdf>",
}
"""The files of a package, besides its mesh; all that may differ is a number."""


def _urdf(mesh: str) -> str:
    return f'<robot name="arm"><link name="base">{_SHAPE.format(mesh)}</link>{_BEAM.format(1)}{_HINGE}</robot>'


SOURCES = {
    "xacro": (
        "arm.urdf.xacro",
        _XACRO.format(f'<link name="base"/><xacro:include filename="$(find pk)/beam.xacro"/>{_HINGE}'),
    ),
    "sdf": (
        "arm.sdf",
        '<sdf version="1.9"><model name="arm"><include><uri>model://pk</uri></include>'
        '<joint name="hinge" type="revolute"><parent>world</parent><child>pk::beam</child><axis/></joint>'
        "</model></sdf>",
    ),
    "meshed": ("arm.urdf", _urdf("package://pk/a.stl")),
    "relative": ("relative.urdf", _urdf("pk/a.stl")),
    "library": ("library.urdf", _urdf("modelica://pk/a.stl")),
    "mjcf": ("arm.xml", '<mujoco model="arm"><worldbody><include file="parts/all.xml"/></worldbody></mujoco>'),
}
"""Sources in `robots`, by the names of their robots: each names one package `pk`, or the file `beam.xml`."""
_MJCF_BEAM = """<mujocoinclude><body name="beam"><joint name="hinge" axis="0 1 0"/>
<inertial pos="0 0 0" mass="{}" diaginertia="1 1 1"/></body></mujocoinclude>"""
NAMED = {"xacro", "sdf"}
"""The robots that look for the folder of a package; a mesh needs any folder with its file."""
PACKAGES, PLAIN = {*NAMED, "meshed"}, {"relative"}


class Project:
    """Robots whose package is in some folders, and all that decides which one is found."""

    def __init__(self, folder: Path, robots: Iterable[str], patch: pytest.MonkeyPatch) -> None:
        self.folder, self._robots, self._patch = folder, sorted(robots), patch
        for file, text in SOURCES.values():
            self.write(f"robots/{file}", text)
        self.write("robots/parts/all.xml", '<mujocoinclude><include file="beam.xml"/></mujocoinclude>')
        self.beam("robots/parts", 1)

    def path(self, place: Place) -> Path:
        """The path of a file or folder."""
        return self.folder.parent / place[1:] if place.startswith("/") else self.folder / place

    def write(self, place: Place, text: str) -> None:
        """Write a file."""
        self.path(place).parent.mkdir(parents=True, exist_ok=True)
        self.path(place).write_text(text)

    def package(self, place: Place, number: int) -> None:
        """Write the package with this number."""
        for name, text in _PACKAGE.items():
            self.write(f"{place}/{name}", text.format(number))
        self.write(f"{place}/a.stl", stl(number))

    def beam(self, place: Place, number: int) -> None:
        """Write the included file of the MJCF with this number."""
        self.write(f"{place}/beam.xml", _MJCF_BEAM.format(number))

    def paths(self, *places: Place) -> None:
        """Configure the robots, with these `package_paths`."""
        folders = [str(self.path(place)) if place.startswith("/") else place for place in places]
        lines = [f"[defaults]\npackage_paths = {folders}\n".replace("'", '"')]
        lines += [
            f'[robots.{name}]\nsource = "robots/{SOURCES[name][0]}"\npackage = "{name.capitalize()}"\n'
            for name in self._robots
        ]
        self.write("urdfsync.toml", "".join(lines))

    def variable(self, name: str, *places: Place) -> None:
        """Set a variable of the environment to folders."""
        self._patch.setenv(name, os.pathsep.join(str(self.path(place)) for place in places))

    def link(self, place: Place, target: str) -> None:
        """Write a link."""
        self.path(place).unlink(missing_ok=True)
        self.path(place).symlink_to(target)


Change = Callable[[Project], object]


def _two(first: Place, second: Place, *paths: Place) -> Change:
    """The package in one or two places, and the `package_paths`."""

    def make(project: Project) -> None:
        project.paths(*paths)
        project.package(first, 1)
        project.package(second, 2)

    return make


def _then(first: Change, second: Change) -> Change:
    """Both, one after the other."""

    def make(project: Project) -> None:
        first(project)
        second(project)

    return make


ENVIRONMENTS: dict[str, tuple[Change, Change, set[str]]] = {
    "a new entry of package_paths": (
        _two("one/pk", "two/pk", "one"), lambda p: p.paths("two", "one"), PACKAGES | PLAIN),
    "a new entry of package_paths before the folder of the source": (
        _two("robots/pk", "two/pk"), lambda p: p.paths("two"), PACKAGES),
    "another order of package_paths": (
        _two("one/pk", "two/pk", "one", "two"), lambda p: p.paths("two", "one"), PACKAGES | PLAIN),
    "a folder that comes to the first entry": (
        _two("one/pk", "zero", "zero", "one"), lambda p: p.package("zero/pk", 3), PACKAGES | PLAIN),
    "a folder nearer to the source": (
        _two("pk", "other"), lambda p: p.package("robots/pk", 3), PACKAGES | PLAIN | {"library"}),
    "ROS_PACKAGE_PATH": (
        _two("robots/pk", "/ros/pk"), lambda p: p.variable("ROS_PACKAGE_PATH", "/ros"), PACKAGES),
    "AMENT_PREFIX_PATH": (
        _two("pk", "/ros/share/pk"), lambda p: p.variable("AMENT_PREFIX_PATH", "/ros"), PACKAGES),
    "a folder that comes to ROS_PACKAGE_PATH": (
        _then(_two("robots/pk", "other"), lambda p: p.variable("ROS_PACKAGE_PATH", "/ros")),
        lambda p: p.package("/ros/pk", 3), PACKAGES),
    "MODELICAPATH": (
        _two("robots/pk", "/libraries/pk"), lambda p: p.variable("MODELICAPATH", "/libraries"), {"library"}),
    "a folder that goes": (
        _two("one/pk", "two/pk", "one", "two"), lambda p: shutil.rmtree(p.path("one/pk")), PACKAGES | PLAIN),
    "a package below a search path, whose name counts before that of a folder": (
        _then(_two("one/pk", "two", "one"), lambda p: p.path("one/pk/package.xml").unlink()),
        lambda p: p.package("one/deep/pk-2.0", 3), NAMED),
    "a package with another name": (
        _two("one/pk", "two/pk", "one", "two"),
        lambda p: p.write("one/pk/package.xml", "<package><name>other</name></package>"), NAMED),
    "a package that is to be ignored": (
        _two("one/deep/pk-1.0", "two/deep/pk-2.0", "one", "two"),
        lambda p: p.write("one/deep/COLCON_IGNORE", ""), PACKAGES),
    "the package around the source": (
        _then(_two("one/pk", "robots", "one"), lambda p: p.path("robots/package.xml").unlink()),
        lambda p: p.write("robots/package.xml", "<package><name>pk</name></package>"),
        NAMED),
    "a link to another folder": (
        _then(_two("a/pk", "b/pk", "link"), lambda p: p.link("link", "a")), lambda p: p.link("link", "b"),
        PACKAGES | PLAIN),
    "an included file in the folder of the source": (
        _two("pk", "other"), lambda p: p.beam("robots", 3), {"mjcf"}),
}  # fmt: skip
"""The package before, a change of the place where it is found, and the robots which that changes."""


def out_of_step(execute: Execute, *command: str) -> set[str]:
    """The robots of which a command says that they are not in step, or that they fail."""
    printed = execute(*command, "--format", "json", code=None)
    results = printed.json["results"]
    assert printed.code in (0, 1, 2), printed
    results = [result.get("result", result) for result in results]
    return {result["robot"] for result in results if not result["in_step"]}


@pytest.fixture
def in_step(
    name: str, tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> tuple[Project, Repository, Change, set[str]]:
    """A project in step before an environment changes, all of which is committed and remembered."""
    monkeypatch.setattr(facts, "YOUNG", SHORT)
    before, change, changed = ENVIRONMENTS[name]
    project = Project(tmp_path / "project", PACKAGES | changed, monkeypatch)
    before(project)
    repository = Repository(project.folder, monkeypatch)
    monkeypatch.chdir(project.folder)
    execute("build")
    repository.commit()
    save("build")
    execute("hook", "check")
    return project, repository, change, changed


@NEEDS_GIT
@pytest.mark.slow
@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_no_command_is_green_by_mistake(
    in_step: tuple[Project, Repository, Change, set[str]], execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    project, repository, change, changed = in_step
    change(project)
    repository.git("add", "-A")
    noticed = {
        command: out_of_step(execute, *command.split()) for command in ("build --check", "status", "diff", "hook check")
    }
    repository.commit()
    repository.git("clone", "-q", ".", "../clone")
    with monkeypatch.context() as patch:
        patch.chdir("../clone")
        noticed["in a clone"] = out_of_step(execute, "build", "--check")
    assert noticed == dict.fromkeys(noticed, changed)
    execute("build")
    for command in (["build", "--check"], ["build", "--check", "--full"]):
        assert out_of_step(execute, *command) == set()


@NEEDS_GIT
@pytest.mark.slow
@pytest.mark.parametrize("name", ["a folder nearer to the source"])
def test_what_is_not_staged_is_no_place_for_a_commit(
    in_step: tuple[Project, Repository, Change, set[str]], execute: Execute
) -> None:
    project, repository, change, changed = in_step
    change(project)
    execute("hook", "check")
    repository.git("add", "-A")
    assert out_of_step(execute, "hook", "check") == changed


def test_a_translator_looks_for_included_files_in_the_clone(tmp_path: Path) -> None:
    top, clone, outside = (tmp_path / name for name in ("top", "clone", "outside"))
    for folder in (top / "parts", clone, outside):
        folder.mkdir(parents=True)
    for file in (top / "beam.xml", top / "parts/beam.xml", outside / "beam.xml"):
        file.touch()
    (clone / "parts").symlink_to(outside)
    files = Files({}, [str(top)])
    assert files.is_there(str(top / "beam.xml"))
    with Clone(str(top), str(clone)):
        assert not files.is_there(str(top / "beam.xml"))
        assert files.is_there(str(top / "parts/beam.xml"))
        with pytest.raises(TranslationError, match="outside of the project"):
            files.check_inside(str(top / "parts/beam.xml"), ("", 0))
    assert files.hashes == {str(top / "beam.xml"): None}
