"""Which folder holds the ROS package, or the Modelica library, of a name."""

import os
from pathlib import Path

import pytest

from urdfsync.engine.ros_packages import find, libraries


def package(folder: Path, name: str) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(f"<package format='2'>\n  <name> {name} </name>\n</package>\n")
    return folder


def test_packages_are_found_at_any_depth_and_by_the_name_that_they_say(tmp_path: Path) -> None:
    arm = package(tmp_path / "src" / "robots-main" / "arm-2.1", "arm_description")
    assert find([tmp_path / "src"], tmp_path / "cad" / "arm.urdf") == {"arm_description": arm}


def test_a_package_around_the_source_is_found_without_a_search_path(tmp_path: Path) -> None:
    arm = package(tmp_path / "clone", "arm_description")
    assert find([], arm / "urdf" / "arm.urdf") == {"arm_description": arm}


def test_of_two_packages_of_one_name_the_first_counts(tmp_path: Path) -> None:
    packages = [package(tmp_path / place / "arm", "arm") for place in ("overlay", "base")]
    assert find([tmp_path / "overlay", tmp_path / "base"], tmp_path / "arm.urdf") == {"arm": packages[0]}


@pytest.mark.parametrize("marker", ["CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE"])
def test_folders_that_ask_for_it_are_passed_over(tmp_path: Path, marker: str) -> None:
    package(tmp_path / "old" / "arm", "arm")
    (tmp_path / "old" / marker).touch()
    assert find([tmp_path], tmp_path / "arm.urdf") == {}


def test_hidden_folders_and_packages_inside_of_packages_are_no_packages(tmp_path: Path) -> None:
    package(tmp_path / ".git" / "arm", "arm")
    outer = package(tmp_path / "outer", "outer")
    package(outer / "inner", "inner")
    assert find([tmp_path], tmp_path / "arm.urdf") == {"outer": outer}


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
