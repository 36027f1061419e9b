"""Snapshots under new names, with extensions keyed by what they are about."""

from __future__ import annotations

import support.urdfs as urdfs
from support.packages import read

from urdfsync.domain import Snapshot
from urdfsync.urdf.diff.comparable import comparable


def snapshot(*elements: str) -> Snapshot:
    result = read(urdfs.robot(*elements).encode()).snapshot
    assert result is not None
    return result


ARM = (
    '<link name="base"/><link name="one"/><link name="two"/>',
    '<joint name="lead" type="continuous"><parent link="base"/><child link="one"/></joint>',
    '<joint name="follow" type="continuous"><parent link="one"/><child link="two"/><mimic joint="lead"/></joint>',
)


def test_names_change_wherever_they_are_mentioned() -> None:
    renamed = comparable(snapshot(*ARM), {("link", "one"): "first", ("joint", "lead"): "leader"})
    assert list(renamed["links"]) == ["base", "first", "two"]
    assert (renamed["joints"]["leader"]["child"], renamed["joints"]["follow"]["parent"]) == ("first", "first")
    assert renamed["joints"]["follow"]["mimic"]["joint"] == "leader"


def test_a_link_and_a_joint_of_one_name_are_not_mixed_up() -> None:
    same = snapshot(
        '<link name="a"/><link name="b"/>',
        '<joint name="a" type="fixed"><parent link="a"/><child link="b"/></joint>',
    )
    renamed = comparable(same, {("joint", "a"): "c"})
    assert (list(renamed["links"]), list(renamed["joints"])) == (["a", "b"], ["c"])
    assert renamed["joints"]["c"]["parent"] == "a"


def test_joints_that_can_be_driven_say_whether_they_are() -> None:
    joints = (
        *ARM,
        '<link name="three"/><link name="four"/>',
        '<joint name="caster" type="continuous"><parent link="one"/><child link="three"/></joint>',
        '<joint name="weld" type="fixed"><parent link="one"/><child link="four"/></joint>',
    )
    silent = comparable(snapshot(*joints), {})["joints"]
    assert {name: joint.get("drive") for name, joint in silent.items()} == {
        "lead": "driven", "follow": None, "caster": "driven", "weld": None
    }  # fmt: skip
    told = snapshot(*joints, '<transmission name="t"><joint name="lead"/></transmission>')
    renamed = comparable(told, {("joint", "caster"): "roll", ("joint", "lead"): "first"})["joints"]
    assert {name: joint.get("drive") for name, joint in renamed.items()} == {
        "first": "driven", "follow": None, "roll": "passive", "weld": None
    }  # fmt: skip
    assert not any("actuated" in joint for joint in renamed.values())
    assert "drive" not in told["joints"]["lead"], "a snapshot is changed by nobody"


def test_extensions_are_keyed_by_their_subject_so_that_one_more_is_one_change() -> None:
    gazebo = '<gazebo reference="{}"><mu1>1</mu1></gazebo>'
    first = comparable(snapshot(*ARM, gazebo.format("one"), gazebo.format("two")), {})["extensions"][""]
    second = comparable(snapshot(*ARM, *map(gazebo.format, ("base", "one", "two"))), {})["extensions"][""]
    assert list(first) == ["gazebo one", "gazebo two"]
    assert second.keys() - first.keys() == {"gazebo base"}
    assert all(second[key] == first[key] for key in first)


def test_extensions_without_a_subject_are_numbered() -> None:
    found = comparable(snapshot(*ARM, "<gazebo><a/></gazebo>", "<gazebo><b/></gazebo>"), {})["extensions"][""]
    assert list(found) == ["gazebo", "gazebo (2)"]


def test_extensions_of_a_renamed_element_go_with_it() -> None:
    sensor = snapshot('<link name="eye"><sensor name="camera"/></link>')
    assert comparable(sensor, {("link", "eye"): "head"})["extensions"].keys() == {"link head"}
