"""What must hold in a robot: which finding a robot that does not keep to it has, and at which element."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.urdfs import limit, mimic

from urdfsync.formats.urdf.parse.source import RobotReading, read_robot


def read(*lines: str) -> RobotReading:
    """A robot with one element a line, the first of which is line 1."""
    return read_robot("\n".join(['<robot name="r">' + lines[0], *lines[1:], "</robot>"]).encode(), "a.urdf")


def found(*lines: str) -> str:
    """The findings with their lines: `error cycle 3`."""
    return ", ".join(f"{one.severity} {one.code} {one.line}" for one in read(*lines).diagnostics)


def elements(words: str) -> list[str]:
    """`a` is a link, `a>b` a joint between two links, which has its own name in `name:a>b`."""
    lines = []
    for word in words.split():
        name, _, ends = word.rpartition(":")
        parent, arrow, child = ends.partition(">")
        line = (
            f'<joint name="{name or ends}" type="continuous"><parent link="{parent}"/><child link="{child}"/></joint>'
        )
        lines.append(line if arrow else f'<link name="{word}"/>')
    return lines


def joint(inner: str, kind: str = "revolute", name: str = "j", child: str = "b") -> str:
    return f'<joint name="{name}" type="{kind}"><parent link="a"/><child link="{child}"/>{inner}</joint>'


def cases(table: str) -> list[list[str]]:
    """Lines of columns with blanks between them; what a line ends with may be missing."""
    return [[*re.split(r"\s{2,}", line.strip()), ""] for line in table.strip().splitlines()]


TREES = """
    a b a:a>b                       no findings
    a a b c j:a>b j:a>c             error duplicate-link 2, error duplicate-joint 6
    a b c j:a>x k:y>b               error unknown-child 4, error unknown-parent 5
    a b c j:a>c k:a>b l:b>c         error two-parents 6
    a b c j:a>b                     error several-roots 3
    a a>a                           error cycle 2
    a b c d e a>b b>a c>d d>c a>e   error cycle 7, error cycle 9
"""
"""Ends that do not exist hide the question of roots."""


@pytest.mark.parametrize("case", cases(TREES))
def test_links_and_joints_are_a_tree_of_unique_names(case: list[str]) -> None:
    assert (found(*elements(case[0])) or "no findings") == case[1]


def test_roots_and_cycles_are_named() -> None:
    (roots,) = read(*elements("a b c a>b")).diagnostics
    assert "'a', 'c'" in roots.message
    (cycle,) = read(*elements("a b c d b>c c>d d>b")).diagnostics
    assert cycle.message.partition(": ")[2] in (
        "'b' → 'c' → 'd' → 'b'", "'c' → 'd' → 'b' → 'c'", "'d' → 'b' → 'c' → 'd'"
    )  # fmt: skip


NUMBERS = """
    continuous  <axis xyz="0 0 1.0000005"/>
    continuous  <axis xyz="0.57735 0.57735 0.57735"/>
    continuous  <axis xyz="0.6 0 0.800003"/>
    continuous  <axis xyz="0.5773 0.5773 0.5773"/>                          warning axis-not-unit
    continuous  <axis xyz="1 1 0"/>                                         warning axis-not-unit
    continuous  <axis xyz="1e-200 0 0"/>                                    warning axis-not-unit
    continuous  <axis xyz="1e200 1e200 1e200"/>                             warning axis-not-unit
    continuous  <axis xyz="0 0 0"/>                                         error zero-axis
    revolute    <limit lower="1" upper="-1" effort="1" velocity="1"/>       error limit-order
    prismatic   <limit lower="1" upper="-1" effort="1" velocity="1"/>       error limit-order
    continuous  <limit lower="1" upper="-1" effort="1" velocity="1"/>
    continuous  <limit lower="-1" upper="1" effort="1" velocity="1"/>       warning limit-without-effect
    continuous  <limit lower="0" upper="0" effort="1" velocity="1"/>
    revolute    <limit lower="1" upper="1" effort="1" velocity="1"/>
    revolute    <limit lower="0" upper="1" effort="-1" velocity="1"/>       warning negative-limit
    revolute    <limit lower="0" upper="1" effort="1" velocity="-1"/>       warning negative-limit
    revolute    <limit lower="0" upper="1" effort="0" velocity="0"/>       warning zero-limits
    revolute    <limit lower="0" upper="0" effort="1" velocity="1"/>       warning zero-limits
    revolute    <limit lower="0" upper="1" effort="0" velocity="1"/>
    continuous  <dynamics damping="1" friction="1"/>
    continuous  <dynamics damping="-1"/>                                    warning negative-dynamics
    continuous  <dynamics friction="-1"/>                                   warning negative-dynamics
    planar      <dynamics damping="1"/>
    planar      <dynamics damping="1" armature="1"/>                        warning dynamics-without-effect
    fixed       <dynamics damping="0" friction="0"/>
    fixed       <dynamics damping="-1"/>                                    warning dynamics-without-effect
    floating    <dynamics friction="1"/>                                    warning dynamics-without-effect
    ball        <dynamics damping="1"/>
    ball        <dynamics damping="1" friction="1"/>                        warning dynamics-without-effect
    ball        <limit lower="-1" upper="1" effort="1" velocity="1"/>       warning limit-without-effect
"""


@pytest.mark.parametrize("case", cases(NUMBERS))
def test_numbers_of_a_joint(case: list[str]) -> None:
    kind, inner, finding, *_ = case
    assert found(*elements("a b"), joint(f"\n{inner}", kind)) == (finding and f"{finding} 4")


def test_only_the_losses_without_effect_are_named() -> None:
    losses = '<dynamics damping="1" armature="2"/>'
    messages = [read(*elements("a b"), joint(losses, kind)).diagnostics[0].message for kind in ("planar", "floating")]
    assert [message.partition(": ")[2] for message in messages] == [
        "armature of <dynamics> can't act on a planar joint",
        "damping and armature of <dynamics> can't act on a floating joint",
    ]


FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(st.tuples(FINITE, FINITE, FINITE).filter(any))
def test_axes_become_unit_vectors_and_once_is_enough(axis: tuple[float, float, float]) -> None:
    def unit(numbers: tuple[float, float, float]) -> tuple[float, float, float]:
        robot = read(*elements("a b"), joint(f'<axis xyz="{" ".join(map(repr, numbers))}"/>', "continuous")).robot
        assert robot is not None
        return robot.joints[0].axis

    first = unit(axis)
    assert abs(math.hypot(*first) - 1) < 1e-12
    assert unit(first) == first
    assert all(ours * theirs >= 0 for ours, theirs in zip(first, axis, strict=True))


MIMICS = """
    revolute    prismatic
    continuous  fixed        warning mimic-without-effect 5
    continuous  planar       error mimic-type 5
    continuous  floating     error mimic-type 5
    fixed       continuous   warning mimic-of-fixed 5
    planar      continuous   error mimic-type 5
    floating    continuous   error mimic-type 5
"""


@pytest.mark.parametrize("case", cases(MIMICS))
def test_what_can_follow_what(case: list[str]) -> None:
    leader, follower, finding, *_ = case
    limits = {kind: limit() for kind in ("revolute", "prismatic")}
    joints = joint(limits.get(leader, ""), leader), joint(limits.get(follower, "") + mimic("j"), follower, "k", "c")
    assert found(*elements("a b c"), *joints) == finding


@pytest.mark.parametrize(("leaders", "finding"), [
    (" jk", ""),
    ("ljk", "error mimic-cycle 5"),
    ("j  ", "error mimic-cycle 5"),
    ("x  ", "error unknown-mimic 5"),
])  # fmt: skip
def test_joints_follow_in_chains_and_not_in_circles(leaders: str, finding: str) -> None:
    joints = [
        joint(mimic(leader) if leader.strip() else "", "continuous", name, child)
        for leader, name, child in zip(leaders, "jkl", "bcd", strict=True)
    ]
    assert found(*elements("a b c d"), *joints) == finding


SHAPES = """
    <box size="1 1 1"/>
    <box size="1 0 1"/>                           is empty
    <box size="1 -1 1"/>                          is empty
    <cylinder radius="1" length="1"/>
    <cylinder radius="0" length="1"/>             is empty
    <cylinder radius="1" length="0"/>             is empty
    <capsule radius="1" length="0"/>
    <capsule radius="0" length="1"/>              is empty
    <capsule radius="1" length="-1"/>             is empty
    <sphere radius="0"/>
    <sphere radius="-1"/>                         is empty
    <ellipsoid radii="1 2 3"/>
    <ellipsoid radii="1 0 1"/>                    is empty
    <ellipsoid radii="1 1 -1"/>                   is empty
    <mesh filename="a.stl" scale="-1 1 1"/>
    <mesh filename="a.stl" scale="1 0 1"/>        is empty
"""


@pytest.mark.parametrize("case", cases(SHAPES))
def test_sizes_of_shapes(case: list[str]) -> None:
    shape, is_empty, *_ = case
    lines = [f"<{group}>\n<geometry>{shape}</geometry></{group}>" for group in ("visual", "collision")]
    expected = "warning shape-size 3, warning shape-size 5" if is_empty else ""
    assert found('<link name="a">', *lines, "</link>") == expected
