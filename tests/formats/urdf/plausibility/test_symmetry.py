"""Left and right parts are compared as mirror images: masses, centres, inertias, limits and losses."""

from __future__ import annotations

from typing import NamedTuple

import pytest
from support.corpus import FOLDER, robots
from support.packages import read
from support.urdfs import dynamics, joint, limit, robot

BASE = '<link name="base"/>'
MESH = '<visual><geometry><mesh filename="package://p/hip.stl"/></geometry></visual>'


class Leg(NamedTuple):
    """A link beside the base, and the joint that leads to it."""

    y: float = 0.085
    mass: float = 2.0
    center: str = "0.02 0.005 0.04"
    products: tuple[float, float, float] = (0.001, 0.0002, 0.0003)
    shape: str = ""
    rpy: str = "0 0 0"
    axis: str = "0 1 0"
    inside: str = ""

    def elements(self, name: str) -> tuple[str, str]:
        ixy, ixz, iyz = self.products
        tensor = f'<inertia ixx="0.012" iyy="0.009" izz="0.007" ixy="{ixy}" ixz="{ixz}" iyz="{iyz}"/>'
        inertial = f'<inertial><origin xyz="{self.center}"/><mass value="{self.mass}"/>{tensor}</inertial>'
        xyz, inside = f"-0.02 {self.y} -0.27", [self.inside] if self.inside else []
        way = joint(f"{name}_j", "revolute", "base", name, xyz=xyz, rpy=self.rpy, axis=self.axis, inside=inside)
        return f'<link name="{name}">{inertial}{self.shape}</link>', way


LEFT = Leg()
RIGHT = Leg(-0.085, center="0.02 -0.005 0.04", products=(-0.001, 0.0002, -0.0003))
COPY = LEFT._replace(y=-0.085)


def told(**legs: Leg) -> list[str]:
    elements = (element for name, leg in legs.items() for element in leg.elements(name))
    return [one.message for one in read(robot(BASE, *elements).encode()).diagnostics if one.code == "not-mirrored"]


@pytest.mark.parametrize(("left", "right"), [
    ("left_hip", "right_hip"), ("LHip", "RHip"), ("hip_l", "hip_r"), ("FL_hip", "FR_hip"), ("leftHip", "rightHip"),
    ("hip_LEFT", "hip_RIGHT"),
])  # fmt: skip
def test_names_propose_pairs(left: str, right: str) -> None:
    assert told(**{left: LEFT, right: RIGHT}) == []
    (found,) = told(**{left: LEFT, right: COPY})
    assert found.startswith(f"link {max(left, right)!r} is no mirror image of {min(left, right)!r}: the centre of mass")
    assert found.endswith("is 0.01 m beside its mirror image; the numbers are a copy")


@pytest.mark.parametrize(("right", "words"), [
    (RIGHT._replace(mass=3.0), "its mass is 3 kg, that of the other 2"),
    (RIGHT._replace(mass=0.0), "its mass is 0 kg, that of the other 2"),
    (RIGHT._replace(products=LEFT.products), "an element of the inertia is 0.002 kg·m² beside its mirror image"),
    (RIGHT._replace(axis="1 0 0"), "its axis has another direction"),
])  # fmt: skip
def test_a_difference_is_told(right: Leg, words: str) -> None:
    (found,) = told(left=LEFT, right=right)
    assert words in found


@pytest.mark.parametrize(("left", "right", "words"), [
    (limit(effort=20), limit(effort=10), "its effort is 10, that of the other 20"),
    (limit(velocity=3), limit(velocity=4), "its velocity is 4, that of the other 3"),
    (dynamics(1, 2), dynamics(1, 3), "its friction is 3, that of the other 2"),
    (limit(-0.5, 2), limit(-2, 0.5), "moves from -2 to 0.5, the mirror image of the other from -0.5 to 2"),
])  # fmt: skip
def test_joints_are_compared_too(left: str, right: str, words: str) -> None:
    (found,) = told(left=LEFT._replace(inside=left), right=RIGHT._replace(inside=right))
    assert words in found


@pytest.mark.parametrize(("limits", "axis", "is_told"), [
    (limit(-2, 0.5), "1 0 0", False), (limit(-0.5, 2), "-1 0 0", False), (limit(-0.5, 2), "1 0 0", True),
])  # fmt: skip
def test_a_mirror_reverses_turns_about_axes_in_its_plane(limits: str, axis: str, is_told: bool) -> None:
    left = LEFT._replace(inside=limit(-0.5, 2), axis="1 0 0")
    assert bool(told(left=left, right=RIGHT._replace(inside=limits, axis=axis))) == is_told


@pytest.mark.parametrize("right", [
    COPY._replace(shape=MESH),  # one part, twice
    COPY._replace(y=-0.3),  # beside a robot of another kind
    COPY._replace(rpy="0.5 0 0"),  # in another pose at 0
])  # fmt: skip
def test_what_is_not_built_as_a_mirror_image_is_not_compared(right: Leg) -> None:
    others = {"left_eye": LEFT, "right_eye": RIGHT, "left_ear": LEFT, "right_ear": RIGHT}
    assert told(left=LEFT._replace(shape=MESH), right=right, **others) == []


def test_screws_are_not_compared() -> None:
    assert told(left=LEFT._replace(mass=0.04), right=COPY._replace(mass=0.01)) == []


@pytest.mark.usefixtures("corpus")
@pytest.mark.parametrize("file", robots())
def test_real_robots(file: str) -> None:
    """Judged by hand: one of the 42 has legs and arms with other masses on both sides."""
    codes = {one.code for one in read((FOLDER / file).read_bytes()).diagnostics}
    assert ("not-mirrored" in codes) == file.endswith("/robotisOP2.urdf")


def test_shapes_of_another_size_are_told() -> None:
    small, large = (f'<visual><geometry><sphere radius="{radius}"/></geometry></visual>' for radius in (0.05, 0.08))
    (found,) = told(left_hip=LEFT._replace(shape=small), right_hip=RIGHT._replace(shape=large))
    assert (
        found == "link 'right_hip' is no mirror image of 'left_hip': its shapes reach 0.08 m, those of the other 0.05"
    )
    assert told(left_hip=LEFT._replace(shape=small), right_hip=RIGHT._replace(shape=small)) == []


def test_of_two_sides_the_impossible_one_is_told_as_wrong() -> None:
    (found,) = told(left_hip=LEFT._replace(mass=2.5, products=(0.1, 0, 0)), right_hip=RIGHT)
    assert found.startswith("link 'left_hip' is no mirror image of 'right_hip': its mass is 2.5 kg")
