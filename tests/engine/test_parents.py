"""The packages around a generated one: what has to be there, and what is written beside the robot's own files."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync import cli, config
from urdfsync.diagnostics import OutputError
from urdfsync.engine import parents
from urdfsync.engine.parents import Parents

USES = (("Modelica", "4.0.0"),)


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def package(folder: Path, order: str | None = None) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(f"package {folder.name}\n  model Inner end Inner;\nend {folder.name};\n")
    if order is not None:
        (folder / "package.order").write_text(order)
    return folder


def check(root: Path, name: str, create: bool = False) -> Parents:
    text = f'[robots.arm]\nsource = "arm.urdf"\npackage = "{name}"\ncreate_parents = {str(create).lower()}\n'
    loaded = config.parse(text, root / "urdfsync.toml", "urdfsync.toml")
    return parents.check(loaded, loaded.robots[0], USES)


def test_a_top_level_package_needs_no_parent(root: Path) -> None:
    assert check(root, "Arm") == Parents({}, {}, listed=False)


def test_an_order_file_is_not_begun_in_a_package_that_has_other_classes(root: Path) -> None:
    plant = package(root / "modelica/Plant")
    assert not check(root, "Plant.Arm").listed
    made = check(root, "Plant.Robots.Arm", create=True)
    assert set(made.created) == {plant / "Robots/package.mo"}
    assert made.entered == {}
    assert made.listed, "the file of a package that urdfsync makes is complete"


def test_an_order_file_that_is_there_is_kept_up(root: Path) -> None:
    plant = package(root / "modelica/Plant", "Inner\n")
    assert check(root, "Plant.Arm").listed
    assert check(root, "Plant.Robots.Arm", create=True).entered == {plant / "package.order": "Robots"}


def test_packages_that_are_made_list_each_other(root: Path) -> None:
    made = check(root, "Plant.Robots.Arm", create=True)
    assert made.entered == {root / "modelica/Plant/package.order": "Robots"}
    assert made.listed


def test_the_library_is_hidden_by_nobody(root: Path) -> None:
    with pytest.raises(OutputError) as caught:
        check(root, "UrdfSync.Arm", create=True)
    assert [str(found) for found in caught.value.diagnostics] == [
        "urdfsync.toml:3: error: robot `arm`: `UrdfSync` is the library that models need; a package of that name "
        "would hide it; choose another top-level package than `UrdfSync` [modelica-name]"
    ]


def test_the_library_builds_its_own_examples(root: Path) -> None:
    package(root / "modelica/UrdfSync", "Examples\n")
    package(root / "modelica/UrdfSync/Examples", "")
    assert check(root, "UrdfSync.Examples.Arm").listed


def test_a_build_begins_no_order_file_beside_classes_that_it_does_not_know(project: Path) -> None:
    plant = package(project / "modelica/Plant")
    file = project / "urdfsync.toml"
    file.write_text(file.read_text().replace('"Ladder"', '"Plant.Ladder"'))
    assert cli.main(["build", "--quiet"]) == 0
    assert (plant / "Ladder/package.order").exists()
    assert not (plant / "package.order").exists()
    (plant / "package.order").write_text("Inner\n")
    assert cli.main(["build", "--full", "--quiet"]) == 0
    assert (plant / "package.order").read_text() == "Inner\nLadder\n"
    (plant / "package.order").unlink()
    assert cli.main(["build", "--quiet"]) == 0
    assert not (plant / "package.order").exists()
    assert cli.main(["build", "--check"]) == 0
