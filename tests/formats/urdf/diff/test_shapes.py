"""Shapes keep their numbers; `scenarios/shapes.txt` has the edits that rest on this."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from urdfsync.domain import Version
from urdfsync.formats.urdf.diff.shapes import keep_numbers
from urdfsync.formats.urdf.robot import Link, Robot, Sphere, Visual, shape_numbers

A, B, C, D = 0.1, 0.2, 0.3, 0.4


def version(radii: Sequence[float], numbers: Sequence[int] = (), link: str = "hand") -> Version:
    given = [*numbers, *[None] * len(radii)]
    visuals = tuple(Visual(Sphere(radius), number=number) for radius, number in zip(radii, given, strict=False))
    return Version(Robot("r", (Link(link, visuals=visuals),)))


@pytest.mark.parametrize(
    ("formers", "radii", "expected"),
    [
        ([], [A, B], [1, 2]),
        ([version([A, B, C])], [B, A, C], [2, 1, 3]),
        ([version([A, B, C])], [D, A, B, C], [4, 1, 2, 3]),
        ([version([A, B, C])], [A, C], [1, 3]),
        ([version([A, C], [1, 3])], [A, D, C], [1, 4, 3]),
        ([version([A, C], [1, 3])], [A, D], [1, 3]),
        ([version([A, B, C])], [A, D, C], [1, 2, 3]),
        ([version([A, C, D], [1, 3, 4]), version([A, B, C])], [D, C, B, A], [4, 3, 2, 1]),
        ([version([A, B]), version([A, B, C])], [C, B, A], [3, 2, 1]),
        ([version([A, C], [1, 4]), version([A, B, D], [1, 2, 4])], [A, B, C, D], [1, 2, 5, 6]),
        ([version([A, B], [5, 5])], [B, A], [6, 7]),
    ],
    ids=[
        "first",
        "exchanged",
        "inserted",
        "removed",
        "gap",
        "changed in a gap",
        "changed",
        "open",
        "git",
        "git adds two",
        "forged",
    ],
)
def test_a_shape_keeps_its_number(formers: Sequence[Version], radii: Sequence[float], expected: Sequence[int]) -> None:
    robot = keep_numbers(version(radii), formers, lambda _: {})
    assert shape_numbers(robot.links[0].visuals) == expected


def test_shapes_keep_their_numbers_in_a_link_with_another_name() -> None:
    robot = keep_numbers(version([B, A]), [version([A, B], link="arm")], lambda _: {("link", "arm"): "hand"})
    assert shape_numbers(robot.links[0].visuals) == [2, 1]


def test_a_name_that_looks_like_a_place_is_no_place() -> None:
    old, new = (
        Version(Robot("r", (Link("hand", visuals=tuple(Visual(Sphere(A), name=name) for name in names)),)))
        for names in (("#2", ""), ("", "#1"))
    )
    assert shape_numbers(keep_numbers(new, [old], lambda _: {}).links[0].visuals) == [1, 2]
