"""Which folder holds the ROS package, or the Modelica library, of a name."""

import os
from pathlib import Path

import pytest

from urdfsync.engine.ros_packages import find, libraries

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
