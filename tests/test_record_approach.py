"""Builds with the record approach: written files, changed numbers, and a change of the approach."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from urdfsync.analysis.checks.package import read_package
from urdfsync.domain import ChangeClass
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result
from urdfsync.project.config import load

SOURCES = Path(__file__).parent / "golden"
RECORD = {"package.mo", "package.order", "TwigParameters.mo", "TwigGeneric.mo"}


class Project:
    """A project that builds one robot, in package `Plant.Twig` or `Twig`."""

    def __init__(self, folder: Path, source: str = "twig.urdf") -> None:
        self.folder, self.source, self.file = folder, folder / source, folder / "urdfsync.toml"
        shutil.copy(SOURCES / source, self.source)
        shutil.copytree(SOURCES / "meshes", folder / "meshes")

    def build(self, approach: str, **options: str) -> Result:
        """Build with these options, all as TOML."""
        lines = ["[robots.twig]", f'source = "{self.source.name}"', 'package = "Twig"']
        lines += [f"{key} = {value}" for key, value in {"approach": approach, **options}.items()]
        self.file.write_text("\n".join(lines) + "\n")
        config = load(self.file)
        (result,) = build(config, config.robots, BuildOptions())
        return result

    def change(self, old: str, new: str) -> None:
        """Replace one place in the source."""
        text = self.source.read_text()
        assert text.count(old) == 1
        self.source.write_text(text.replace(old, new))

    @property
    def package(self) -> Path:
        return self.folder / "modelica" / "Twig"

    def files(self) -> set[str]:
        """The files of the package, by their path below it."""
        return {path.relative_to(self.package).as_posix() for path in self.package.rglob("*") if path.is_file()}

    def models(self) -> tuple[str, ...]:
        """The models that a check would compile."""
        config = load(self.file)
        return tuple(read_package(config, config.robots[0], BuildOptions(dry=True)).models)


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


@pytest.fixture
def zoo(tmp_path: Path) -> Project:
    """A robot with planar and floating joints, and with meshes."""
    return Project(tmp_path, "menagerie.urdf")


def written(result: Result) -> set[str]:
    return {Path(action.path).name for action in result.actions if action.writes}


def test_both_approaches(project: Project) -> None:
    project.build('["package", "record"]')
    more = {"Twig.mo", "TwigRun.mo", "TwigTest.mo", "Links/Stem.mo", "Joints/BendParameters.mo"}
    assert project.files() > RECORD | more
    assert project.models() == ("Twig", "TwigRun", "TwigTest", "TwigGeneric")
    order = (project.package / "package.order").read_text().split()
    assert order == ["Twig", "TwigRun", "TwigTest", "TwigGeneric", "TwigParameters", "Links", "Joints"]


@pytest.mark.slow
def test_no_edit_is_lost_on_the_way_to_the_other_approach_and_to_both(project: Project) -> None:
    edited: list[Path] = []

    def edit(*names: str) -> None:
        for name in names:
            edited.append(project.package / name)
            edited[-1].write_text(edited[-1].read_text() + "// mine\n")

    project.build('["package", "record"]')
    edit("Links/Stem.mo", "Links/BranchParameters.mo", "Twig.mo", "TwigParameters.mo")
    project.build('["record"]')
    edit("TwigGeneric.mo")
    for approach in ('["package", "record"]', '["package"]', '["record"]'):
        assert not project.build(approach).conflicts
        assert [path.read_text().count("// mine") for path in edited] == [1] * len(edited)


@pytest.mark.parametrize(
    ("source", "old", "new"),
    [
        ("twig", '<mass value="1.5"/>', '<mass value="1.625"/>'),
        ("twig", '<axis xyz="0 1 0"/>', '<axis xyz="0 -1 0"/>'),
        ("twig", 'upper="0.15"', 'upper="0.25"'),
        ("twig", 'multiplier="-2"', 'multiplier="-2.5"'),
        ("twig", '<robot name="twig">', '<robot name="sprig">'),
        ("twig", '<link name="bud"/>', '<link name="bud"><inertial><mass value="1"/></inertial></link>'),
        ("menagerie", '<box size="0.6 0.4 0.1"/></geometry>\n', '<box size="0.7 0.4 0.1"/></geometry>\n'),
        ("menagerie", '<color rgba="0.5 0.5 0.55 1"/>', '<color rgba="0.5 0.25 0.55 1"/>'),
        ("menagerie", '<visual><geometry><sphere radius="0.05"/></geometry></visual>', ""),
    ],
)
def test_changes_rewrite_the_record_and_nothing_else(tmp_path: Path, source: str, old: str, new: str) -> None:
    """A removed shape is a structural change, but concerns only the record."""
    project = Project(tmp_path, f"{source}.urdf")
    project.build('["record"]')
    project.change(old, new)
    result = project.build('["record"]')
    assert written(result) == {"TwigParameters.mo"}
    assert result.changes is not None
    assert result.changes.change_class is (ChangeClass.PARAMETER if new else ChangeClass.STRUCTURAL)


def test_where_the_generic_robot_can_not_read_the_record_there_is_no_bench(zoo: Project) -> None:
    result = zoo.build('["record"]')
    assert {"planar-not-generic", "floating-not-generic"} < {found.code for found in result.diagnostics}
    assert {name for name in zoo.files() if "/" not in name} == {"package.mo", "package.order", "TwigParameters.mo"}
    assert zoo.models() == ("TwigParameters",)
    assert "jointTree" not in (zoo.package / "TwigParameters.mo").read_text()


def meshes(package: Project) -> list[str]:
    """The imported files, without the unique part of their names."""
    return sorted(Path(name).stem.partition("_")[0] for name in package.files() if "Resources/" in name)


@pytest.mark.parametrize("base", ['"fixed"', '"floating"'])
def test_meshes_of_collisions_are_imported_if_the_robot_stands_on_them(zoo: Project, base: str) -> None:
    text = zoo.source.read_text()
    zoo.source.write_text(re.sub(r"<visual[ >].*?</visual>", "", text, flags=re.DOTALL))
    zoo.build('["record"]', base=base)
    assert meshes(zoo) == (["wedge"] if base == '"floating"' else [])
