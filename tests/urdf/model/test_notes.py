"""Documentation texts: whatever names are, the HTML stays well-formed and the names stay readable."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from urdfsync.urdf.model import notes
from urdfsync.urdf.robot import Joint, JointType

KINDS: tuple[JointType, ...] = ("fixed", "continuous", "revolute", "prismatic", "planar", "floating")
NAMES = st.text(st.sampled_from("ab<>&\"'/ ;"), min_size=1) | st.sampled_from(["</code></html>", "<!--", "]]>", "&lt;"])


def codes(note: str) -> list[str]:
    """What a reader sees in code type."""
    return [element.text or "" for element in etree.fromstring(f"<p>{note}</p>").iter("code")]


@given(NAMES)
def test_a_links_note_shows_its_name(name: str) -> None:
    assert codes(notes.link_note(name)) == [name]


@given(NAMES, NAMES, NAMES, st.sampled_from(KINDS))
def test_a_joints_note_shows_its_name_and_both_links(name: str, parent: str, child: str, kind: JointType) -> None:
    assert codes(notes.joint_note(Joint(name, kind, parent, child))) == [name, child, parent]


@pytest.mark.parametrize("kind", KINDS)
def test_every_type_of_joint_has_its_own_words(kind: JointType) -> None:
    others = {notes.joint_note(Joint("j", other, "a", "b")) for other in KINDS if other != kind}
    assert notes.joint_note(Joint("j", kind, "a", "b")) not in others


@pytest.mark.parametrize(
    "note",
    [notes.package_note("Arm", bench=True), notes.robot_note("Arm"), notes.run_note("Arm"), notes.test_note("Arm")],
)
def test_notes_of_whole_robots_are_well_formed(note: str) -> None:
    assert etree.fromstring(f"<p>{note}</p>").tag == "p"


def test_a_joints_title_is_a_sentence_without_its_verb() -> None:
    joint = Joint("elbow", "revolute", "upper arm", "forearm")
    assert notes.joint_title(joint) == 'revolute joint "elbow" from link "upper arm" to link "forearm"'
