"""The second reader: each dialect is read to the paths of the records, and yourdfpy counts where it reads a thing."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yourdfpy
from support.numbers import compare
from support.urdfs import joint, link, links, mimic, robot

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Target
from urdfsync.domain.experiment import Sample
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Robot
from urdfsync.formats.urdf.second.comparison import compare_numbers
from urdfsync.formats.urdf.second.reading import read_again

TREE = '<link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
URDF = f'<robot name="r">{TREE}</robot>'
TEXTS = robot(
    '<link name="a"/>',
    '<link name="b"><inertial><pose>0 0 1 0 0 0</pose><mass>2</mass><inertia><ixx>1</ixx></inertia></inertial></link>',
    '<joint name="j" type="revolute"><pose>1 2 3 0.1 0.2 0.3</pose><parent>a</parent><child>b</child>'
    "<axis><xyz>0 1 0</xyz><limit><lower>-1</lower><upper>1</upper></limit>"
    "<dynamics><armature>0.1</armature></dynamics></axis></joint>",
)
MOVING = robot(
    *links(base=4.0, upper=2.5, fore=1.5, hand=0.7, puck=0.3),
    joint("shoulder", "revolute", "base", "upper", axis="0 1 0", rpy="0.4 0.5 0.6"),
    joint("elbow", "prismatic", "upper", "fore", axis="0.3 -0.4 1.2", inside=[mimic("shoulder", -1.5, 0.2)]),
    joint("wrist", "continuous", "fore", "hand", axis="1 1 0", inside=[mimic("elbow", 2)]),
    joint("glide", "planar", "hand", "puck"),
)
"""Followers of followers, axes that are no unit vectors, and a joint without an axis of its own."""


QUATERNION = URDF.replace("<robot", '<robot version="1.1"').replace("<parent", '<origin quat_xyzw="0 0 3 4"/><parent')
COUPLED = robot(
    *links(a=1.0, b=1.0, c=1.0),
    joint("j", "continuous", "a", "b"),
    joint("k", "continuous", "b", "c"),
    "<gazebo><plugin><joint>j</joint><mimicJoint>k</mimicJoint><multiplier>-2</multiplier></plugin></gazebo>",
)
DIALECTS = {
    "plain": URDF,
    "SDF": TEXTS,
    "moving": MOVING,
    "a quaternion": QUATERNION,
    "a coupling of Gazebo": COUPLED,
}


@pytest.mark.parametrize("text", DIALECTS.values(), ids=DIALECTS)
def test_both_readers_read_the_same(text: str) -> None:
    assert compare(text.encode(), approach=("package",)).differences == ()


def test_values_have_the_lines_of_their_elements() -> None:
    read = read_again(TEXTS.encode(), Options())
    assert read.links["b"].values["inertial.mass"][:2] == ((2.0,), 4)
    assert read.joints["j"].values["limits.lower"][:2] == ((-1.0,), 5)
    assert read.joints["j"].values["origin.xyz"].value == (1.0, 2.0, 3.0)
    assert read.joints["j"].values["dynamics.armature"].value == (0.1,)
    assert (read.joints["j"].parent, read.joints["j"].child) == ("a", "b")
    coupled = read_again(COUPLED.encode(), Options()).joints["k"].values["mimic.multiplier"]
    assert coupled[:2] == ((-2.0,), 1 + COUPLED[: COUPLED.index("<gazebo>")].count("\n"))


def test_the_parts_of_a_chain_have_the_line_of_its_joint() -> None:
    """A second child of the joint has no effect, as for the first reader."""
    ends = '<parent link="a"/><child link="b"/><child link="a"/>'
    text = robot(*links(a=1.0, b=1.0), f'<drake:joint name="j" type="universal">{ends}</drake:joint>').encode()
    read = read_again(text, Options())
    parts = read.joints["j_x"], read.joints["j_y"], read.links["j_x"]
    assert {part.line for part in parts} == {5}
    assert (read.joints["j_x"].child, read.joints["j_y"].child) == ("j_x", "b")
    assert compare(text, approach=("package",)).differences == ()


@pytest.mark.parametrize(("part", "place", "expected"), [
    ("limit", "limits.lower", "0.125"), ("mimic", "mimic.offset", "0.125"),
    ("origin", "origin.xyz", "0.125 -0.2 0.3"), ("origin", "origin.rpy", "3.14159265 -0 0"),
])  # fmt: skip
def test_yourdfpy_counts_where_it_reads_a_thing(
    part: str, place: str, expected: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A misreading in both of our readers shows, too."""
    load = yourdfpy.URDF.load

    def otherwise(*arguments: Any, **options: Any) -> yourdfpy.URDF:
        theirs = load(*arguments, **options)
        for each in theirs.robot.joints:
            found = getattr(each, part)
            if place == "origin.xyz":
                found[0, 3] = 0.125
            elif place == "origin.rpy":
                found[:3, :3] = np.diag([1, -1, -1])
            elif found:
                setattr(found, place.rpartition(".")[2], 0.125)
        return theirs

    monkeypatch.setattr(yourdfpy.URDF, "load", otherwise)
    found = compare(MOVING.encode(), approach=("package",)).differences
    assert {(each.quantity, each.expected) for each in found} == {(place, expected)}


SHAPE = '"a"><visual>{}</visual></link>'
REFUSED = {
    "a robot without a name": URDF.replace(' name="r"', ""),
    "a visual without a geometry": URDF.replace('"a"/>', SHAPE.format(""), 1),
    "a plane before a box": URDF.replace('"a"/>', SHAPE.format('<geometry><plane/><box size="1 2 3"/></geometry>'), 1),
    "a capsule": URDF.replace('"a"/>', SHAPE.format('<geometry><capsule radius="1" length="2"/></geometry>'), 1),
    "a colour without numbers": URDF.replace(
        '"a"/>', SHAPE.format('<geometry><box size="1 2 3"/></geometry><material><color rgba="x"/></material>'), 1
    ),
    "a mass without a tensor": URDF.replace('"a"/>', '"a"><inertial><mass value="2"/></inertial></link>', 1),
    "a tensor with one number": URDF.replace('"a"/>', '"a"><inertial><inertia ixy="2"/></inertial></link>', 1),
}


@pytest.mark.parametrize("text", REFUSED.values(), ids=REFUSED)
def test_sources_that_yourdfpy_refuses_or_completes_are_read(text: str, capfd: pytest.CaptureFixture[str]) -> None:
    numbers = compare(text.encode(), approach=("package",))
    assert (numbers.differences, numbers.uncompared) == ((), ())
    assert capfd.readouterr() == ("", "")


def test_a_source_that_can_not_be_read_again_is_an_error() -> None:
    sample = Sample(b'<robot name="r"><joint/></robot>', "a.urdf", Target("Bot", "Bot"), Options(), {})
    with pytest.raises(SourceError, match=r"a\.urdf: error: the second reader fails: "):
        compare_numbers(sample, Robot("r"), [{}])


@pytest.mark.parametrize("head", [
    '<?xml version="1.0" encoding="latin-1"?>\n<robot', '<?xml version="1.0" encoding="utf-16"?>\n<robot',
    '\n<robot xmlns="http://www.ros.org"', '\n<robot xmlns:drake="http://drake.mit.edu"',
])  # fmt: skip
def test_declarations_and_namespaces_make_no_difference(head: str) -> None:
    read = read_again(URDF.replace("<robot", head).encode(), Options())
    assert (set(read.links), read.links["a"].line) == ({"a", "b"}, 2)


def test_a_build_does_not_load_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.urdf").write_text(robot(link("a", 1.0)))
    (tmp_path / "urdfsync.toml").write_text('[robots.a]\nsource = "a.urdf"\npackage = "A"\n')
    program = "import sys; from urdfsync.commands import cli; assert cli.main(['build', '--quiet']) == 0;"
    program += "assert not {'yourdfpy', 'numpy'} & sys.modules.keys()"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
