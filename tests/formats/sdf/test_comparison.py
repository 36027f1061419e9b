"""The second reading of an SDF, which `check` compares with the URDF."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

import pytest
from support.random_sdfs import example
from support.sdfs import FOLDER, SOURCE, arm, hinge, model, sdf, urdf

from urdfsync.engine.sources.ros_packages import Packages
from urdfsync.formats.sdf.comparison import compare
from urdfsync.formats.translation.files import Files

HAND = sdf(
    '<model name="hand" placement_frame="tip"><pose>0 0 9 0 0 0</pose><link name="palm"/><link name="tip">'
    '<pose degrees="true">0 1 0 30 0 0</pose></link></model>'
)
CONFIG = '<model><sdf version="1.4">old.sdf</sdf><sdf version="1.9">hand.sdf</sdf></model>'
FILES = {"hand/hand.sdf": HAND, "hand/model.config": CONFIG}
SHAPES = (
    "<box><size>1 2 3</size></box>",
    "<sphere/>",
    "<ellipsoid/>",
    "<cylinder><radius>2</radius></cylinder>",
    "<capsule/>",
    "<mesh><uri>parts/a.stl</uri><scale>1 2 3</scale></mesh>",
)
PART = (
    '<pose rotation_format="quat_xyzw" relative_to="mark">0.1 0.2 0.3 0.1 0.2 0.3 0.9</pose>'
    "<inertial><pose>0.1 0 0 0 0.2 0</pose><mass>3</mass><inertia><ixx>2</ixx><ixy>0.1</ixy></inertia></inertial>"
    + "".join(
        f'<{tag} name="s{number}">'
        f'<pose relative_to="base">0 {number} 0 0 0 1</pose><geometry>{shape}</geometry></{tag}>'
        for tag in ("visual", "collision")
        for number, shape in enumerate(SHAPES)
    )
)
MORE = (
    '<frame name="mark" attached_to="base"><pose>0 0 1 0 1 0</pose></frame>'
    "<include><uri>hand</uri><name>grip</name><pose>0 0 2 0 0 0</pose></include>"
    '<include merge="1"><uri>hand</uri><pose>1 0 0 0 0 0</pose></include>'
    + hinge("first", "part", "grip::palm")
    + hinge("second", "grip::palm", "tip", "<pose>0 0 0.5 0 0 0</pose><axis/>")
    + hinge("third", "tip", "palm")
    + hinge("fourth", "base", "grip::tip")
)
ARM = arm(PART, "<pose>0 0.2 0 0 0 0</pose><axis/>", MORE)


def differences(
    text: str, old: str = "", new: str = "", files: Mapping[str, str] | None = None
) -> tuple[int, list[str]]:
    """Compare an SDF with its URDF, in which a text has become another one."""
    written, _ = urdf(text, files, "arm")
    assert old in written
    contents = {SOURCE: text.encode()}
    contents |= {os.path.normpath(f"{FOLDER}/{name}"): inside.encode() for name, inside in (files or {}).items()}
    files_read, packages = Files(contents, [FOLDER]), Packages([], Path(SOURCE))
    compared, told = compare(files_read, packages, SOURCE, written.replace(old, new, 1))
    return compared, list(told)


@pytest.mark.parametrize("seed", range(20))
def test_random_robots_are_right(seed: int) -> None:
    compared, told = differences(example(seed).sdf)
    assert compared > 0
    assert told == []


def test_a_robot_with_all_that_is_compared() -> None:
    """Six links of 7 numbers, each with a pose of 16; six shapes with a pose and 14 sizes, seen and touched."""
    assert differences(ARM, files=FILES) == (6 * 23 + 2 * (6 * 16 + 14), [])


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('mass value="3.0"', 'mass value="3.1"', "numbers of inertial of link part differ by 3.3e-02"),
        ('ixx="2.0"', 'ixx="2.2"', "numbers of inertial of link part differ by"),
        ('ixy="0.1"', 'ixy="-0.1"', "numbers of inertial of link part differ by"),
        ('<box size="1.0 2.0 3.0"', '<box size="1.0 2.0 3.3"', "numbers of visual1 (box) of link part differ by"),
        ('<capsule radius="0.5"', '<capsule radius="1.0"', "numbers of visual5 (capsule) of link part differ by"),
        ('scale="1.0 2.0 3.0"', 'scale="0.1 0.2 0.3"', "numbers of visual6 (mesh a.stl) of link part differ by"),
        ("parts/a.stl", "parts/b.stl", "link part has no visual6 (mesh a.stl) in the URDF"),
        ('<sphere radius="1.0"/>', '<box size="1 1 1"/>', "link part has no visual2 (box) in the SDF"),
        ('xyz="0.0 0.0 2.0"', 'xyz="0.0 0.0 2.1"', "poses of inertial of link grip::tip differ by"),
    ],
)
def test_a_fault_of_the_translation_is_told(old: str, new: str, told: str) -> None:
    assert any(each.startswith(told) for each in differences(ARM, old, new, FILES)[1])


def test_an_inertia_that_gazebo_computes_is_not_compared() -> None:
    solid = '<inertial auto="true"/><collision name="c"><geometry><sphere/></geometry></collision>'
    assert differences(arm(solid, version="1.11")) == (23 + 17, [])


@pytest.mark.parametrize("version", ["1.4", "1.6"])
def test_an_older_file_is_read_again(version: str) -> None:
    """`pose/@frame` is an old word, and a link may be called `world`."""
    frame = ' frame="world"' if version == "1.6" else ""
    links = '<link name="world"><pose>0 0 1 0 0 0.5</pose></link>'
    links += f'<link name="part"><pose{frame}>0 1 0 0 0 0</pose></link>'
    assert differences(model(links + hinge("turn", "world", "part"), version, "arm")) == (46, [])
