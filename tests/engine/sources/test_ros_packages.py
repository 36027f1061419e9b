"""Which folder holds the ROS package, or the Modelica library, of a name."""

import os
from pathlib import Path

import pytest

from urdfsync.engine.sources.ros_packages import Packages, find, libraries

IGNORED = ("CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE")


@pytest.mark.parametrize(
    ("packages", "search", "source", "found"),
    [
        pytest.param({"src/robots-main/arm-2.1": "arm"}, ["src"], "cad", {"arm": "src/robots-main/arm-2.1"}, id="deep"),
        pytest.param({"clone": "arm"}, [], "clone/urdf", {"arm": "clone"}, id="around the source"),
        pytest.param({"a/x": "arm", "b/x": "arm"}, ["a", "b"], "cad", {"arm": "a/x"}, id="the first counts"),
        pytest.param({".git/arm": "arm", "o": "out", "o/i": "in"}, ["."], "cad", {"out": "o"}, id="hidden, and inside"),
        *(pytest.param({"a": "arm", f"a/{name}": ""}, ["."], "cad", {}, id=name) for name in IGNORED),
    ],
)
def test_packages_are_found_by_the_name_that_they_say(
    tmp_path: Path, packages: dict[str, str], search: list[str], source: str, found: dict[str, str]
) -> None:
    """At any depth; folders that ask for it are passed over, and so is what is inside of a package."""
    for place, name in packages.items():
        folder = tmp_path / place
        folder.mkdir(parents=True) if name else folder.touch()
        if name:
            (folder / "package.xml").write_text(f"<package format='2'>\n  <name> {name} </name>\n</package>\n")
    folders = [tmp_path / place for place in search]
    assert find(folders, tmp_path / source / "arm.urdf") == {name: tmp_path / place for name, place in found.items()}


@pytest.mark.parametrize(
    ("packages", "place"),
    [
        pytest.param({"ws/cad": "arm", "search/arm": "arm"}, "ws/cad", id="around the source"),
        pytest.param({"search/arm": "arm", "ws/arm": "arm"}, "search/arm", id="in a search path, then beside it"),
        pytest.param({"ws/arm": "arm", "search/a/b": "arm"}, "ws/arm", id="beside the source"),
        pytest.param({"search/deep/arm-2.1": "arm", "ws/arm": ""}, "search/deep/arm-2.1", id="its name counts"),
        pytest.param({"search/arm": ""}, "search/arm", id="without package.xml"),
        pytest.param({"search/arm": "leg"}, "search/arm", id="of another name, if there is no other"),
        pytest.param({"search/leg": "leg"}, None, id="none"),
    ],
)
def test_one_package_is_found(tmp_path: Path, packages: dict[str, str], place: str | None) -> None:
    for folder, name in packages.items():
        (tmp_path / folder).mkdir(parents=True, exist_ok=True)
        if name:
            (tmp_path / folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
    found = Packages([tmp_path / "search"], tmp_path / "ws/cad/urdf/arm.xacro").folder("arm")
    assert found == (tmp_path / place if place else None)


def library(folder: Path) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.mo").touch()
    return folder


def modelicapath(*folders: Path) -> dict[str, str]:
    return {"MODELICAPATH": os.pathsep.join(map(str, folders))}


def test_of_two_libraries_the_first_entry_counts_then_the_one_without_version_then_the_newest(tmp_path: Path) -> None:
    old, new = (library(tmp_path / "b" / f"Plant {version}") for version in ("9.1.0", "10.0.0"))
    assert libraries(modelicapath(tmp_path / "b")) == {"Plant": new}
    plain = library(tmp_path / "b" / "Plant")
    assert libraries(modelicapath(tmp_path / "b")) == {"Plant": plain}
    first = library(tmp_path / "a" / "Plant 1.0.0")
    assert libraries(modelicapath(tmp_path / "a", tmp_path / "b")) == {"Plant": first}
    assert old.exists()
