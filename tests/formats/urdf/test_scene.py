"""Robots as pictures: shapes with their colours, frames, masses and axes."""

from __future__ import annotations

import math

import pytest
from support.loops import FOUR_BAR
from support.robots import tree

from urdfsync.domain import Target
from urdfsync.domain.scene import Scene
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Origin,
    Robot,
    Sphere,
    Visual,
)
from urdfsync.formats.urdf.scene import scene, with_numbers


def picture(*links: Link, joints: tuple[Joint, ...] = ()) -> Scene:
    return scene(Robot("bot", links, joints), {}, Target("Bot", "Bot"), Options())[0]


def test_shapes_have_their_sizes_places_and_colours() -> None:
    red = Material("red", (1.0, 0.0, 0.0, 0.5))
    link = Link(
        "base",
        visuals=(
            Visual(Box((1.0, 2.0, 3.0)), Origin((4.0, 5.0, 6.0), (0.0, 0.0, math.pi / 2)), material=red),
            Visual(Sphere(0.5)),
        ),
        collisions=(
            Collision(Cylinder(0.1, 0.2)),
            Collision(Capsule(0.3, 0.4)),
            Collision(Ellipsoid((0.5, 0.6, 0.7))),
        ),
    )
    box, sphere, cylinder, capsule, ellipsoid = picture(link).bodies[0].shapes
    assert (box.kind, box.form, box.size, box.color) == ("visual", "box", (1.0, 2.0, 3.0), (1.0, 0.0, 0.0, 0.5))
    assert box.pose == pytest.approx((0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1))
    assert (sphere.form, sphere.size) == ("sphere", (0.5,))
    assert (cylinder.kind, cylinder.form, cylinder.size) == ("collision", "cylinder", (0.1, 0.2))
    assert (capsule.form, capsule.size) == ("capsule", (0.3, 0.4))
    assert (ellipsoid.form, ellipsoid.size) == ("ellipsoid", (0.5, 0.6, 0.7))


def test_collisions_are_shown_whatever_the_package_has() -> None:
    robot = Robot("bot", (Link("base", collisions=(Collision(Sphere(1.0)),)),))
    shown, _ = scene(robot, {}, Target("Bot", "Bot"), Options(collisions=False))
    assert len(shown.bodies[0].shapes) == 1


def test_a_mesh_that_is_not_imported_is_missing() -> None:
    shown = picture(Link("base", visuals=(Visual(Mesh("a.stl")),)))
    assert shown.bodies[0].shapes == ()
    assert shown.missing == ("link base, visual 1: mesh `a.stl` is not in the package",)


def test_a_body_has_its_inertia_in_the_frame_of_its_centre() -> None:
    (body,) = picture(
        Link("base", Inertial(3.0, Origin((1.0, 2.0, 3.0)), Inertia(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)))
    ).bodies
    assert (body.mass, body.inertia) == (3.0, (1.0, 2.0, 3.0, 4.0, 5.0, 6.0))
    assert body.center == (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1)


@pytest.mark.parametrize("inertial", [None, Inertial(0.0)])
def test_a_body_without_mass_has_no_centre(inertial: Inertial | None) -> None:
    (body,) = picture(Link("base", inertial)).bodies
    assert (body.mass, body.center) == (0.0, None)


def test_axes_have_limits_starts_and_leaders_which_come_first() -> None:
    limit = Limit(0.5, 1.0, 2.0, 3.0)
    joints = (
        Joint("a", "revolute", "one", "two", limit=limit, mimic=Mimic("b", 2.0, 0.1)),
        Joint("b", "continuous", "two", "three", axis=(0.0, 0.0, 1.0)),
        Joint("c", "floating", "three", "four"),
    )
    shown = picture(*(Link(name) for name in ("one", "two", "three", "four")), joints=joints)
    by_name = {hinge.element: hinge for hinge in shown.hinges}
    assert list(by_name) == ["joint b", "joint c", "joint a"]
    assert (by_name["joint b"].lower, by_name["joint b"].upper) == (None, None)
    follower = by_name["joint a"]
    assert (follower.leader, follower.multiplier, follower.offset) == ("joint b", 2.0, 0.1)
    assert (follower.lower, follower.upper) == (0.5, 1.0)
    assert follower.start == pytest.approx(2.0 * by_name["joint b"].start + 0.1)
    assert by_name["joint c"].motion == "floating"
    assert ("limit effort", "2 N·m") in follower.facts
    assert ("limit upper", "1 rad (57.3°)") in follower.facts


def test_components_are_those_of_the_diagram() -> None:
    names = tree(Joint("arm", "fixed", "arm", "Arm"))
    shown = picture(*names.links, joints=names.joints)
    assert [body.component for body in shown.bodies] == [names.link(link.name).component for link in names.links]


def test_a_loop_has_its_ends_and_equations_and_its_robot_starts_closed() -> None:
    shown, _ = scene(FOUR_BAR, {}, Target("Bot", "Bot"), Options())
    assert [hinge.element for hinge in shown.hinges if hinge.is_dependent] == ["joint crank_pin", "joint rocker_pivot"]
    assert [hinge.start for hinge in shown.hinges] != [joint.start for joint in FOUR_BAR.joints]
    (loop,) = shown.loops
    assert [(end.body, end.pose[12]) for end in loop.ends] == [("link coupler", 0.6), ("link rocker", 0.4)]
    assert (len(loop.translations), len(loop.rotations)) == (2, 0)
    assert ("kind", "revolute") in loop.facts


@pytest.mark.parametrize(
    ("lower", "upper", "velocity", "way"),
    [
        (-2.0, 2.0, 9.0, 1.0),
        (-0.9, 0.5, 9.0, -0.81),
        (0.0, 0.5, 0.1, 0.9 * 0.1 * 10 / math.pi),
        (0.0, 0.0, 9.0, 0.0),
    ],
)
def test_a_driven_joint_has_the_way_that_test_gives_it(lower: float, upper: float, velocity: float, way: float) -> None:
    limit = Limit(lower=lower, upper=upper, effort=1.0, velocity=velocity)
    turn = Joint("turn", "revolute", "base", "arm", limit=limit)
    (hinge,) = picture(Link("base"), Link("arm"), joints=(turn,)).hinges
    assert hinge.way == pytest.approx(way)


def test_a_robot_with_a_free_base_has_the_height_at_which_it_stands() -> None:
    robot = Robot("bot", (Link("base", collisions=(Collision(Box((1.0, 1.0, 0.6))),)),))
    heights = [scene(robot, {}, Target("Bot", "Bot"), Options(base=base))[0].height for base in ("fixed", "floating")]
    assert heights == [None, pytest.approx(0.3)]


EDITED = {
    ("link arm", "inertial.mass"): (3.0,),
    ("link arm", "inertial.origin.xyz"): (0.0, 0.0, 0.5),
    ("link arm", "visual1.radius"): (0.2,),
    ("link arm", "visual1.origin.xyz"): (1.0, 0.0, 0.0),
    ("link arm", "visual1.color"): (255.0, 0.0, 51.0),
    ("joint turn", "axis"): (0.0, 2.0, 0.0),
    ("joint turn", "limits.upper"): (1.5,),
    ("joint turn", "origin.xyz"): (0.0, 0.0, 2.0),
}
LACKING = {
    ("link arm", "visual2.radius"): (1.0,),
    ("link arm", "visual1_2.color"): (1.0, 1.0, 1.0),
    ("link arm", "visual1.size"): (1.0, 1.0, 1.0),
    ("joint turn", "servo.positionGain"): (1.0,),
    ("joint turn", "axis"): (0.0, 0.0, 0.0),
    ("joint gone", "limits.upper"): (1.0,),
}


def test_numbers_of_records_are_drawn_and_those_without_a_place_are_told() -> None:
    arm = Link("arm", Inertial(2.0), visuals=(Visual(Sphere(0.1)),))
    turn = Joint("turn", "revolute", "base", "arm", limit=Limit(-1.0, 1.0))
    robot = Robot("bot", (Link("base"), arm), (turn,))
    edited, lacking = with_numbers(robot, EDITED)
    assert lacking == set()
    material = Material(rgba=(1.0, 0.0, 0.2, 1.0))
    visual = Visual(Sphere(0.2), Origin((1.0, 0.0, 0.0)), material=material)
    assert edited.links == (Link("base"), Link("arm", Inertial(3.0, Origin((0.0, 0.0, 0.5))), visuals=(visual,)))
    (hinge,) = edited.joints
    assert (hinge.axis, hinge.limit, hinge.origin.xyz) == ((0.0, 1.0, 0.0), Limit(-1.0, 1.5), (0.0, 0.0, 2.0))
    assert with_numbers(robot, LACKING) == (robot, LACKING.keys())
