"""Geoms become visuals and collisions, and a mesh stands where MuJoCo has it."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from support.mjcfs import CORNERS, body, document, link, noted, read, reading, stl, world

from urdfsync.formats.translation.files import TranslationError
from urdfsync.formats.urdf.kinematics.poses import pose
from urdfsync.formats.urdf.robot import Box, Capsule, Contact, Cylinder, Ellipsoid, Mesh, Sphere, Visual


@pytest.mark.parametrize(
    ("written", "geometry"),
    [
        ('type="box" size="0.1 0.2 0.3"', Box((0.2, 0.4, 0.6))),
        ('type="sphere" size="0.1"', Sphere(0.1)),
        ('type="ellipsoid" size="0.1 0.2 0.3"', Ellipsoid((0.1, 0.2, 0.3))),
        ('type="cylinder" size="0.1 0.2"', Cylinder(0.1, 0.4)),
        ('type="capsule" size="0.1 0.2"', Capsule(0.1, 0.4)),
        ('type="capsule" size="0.1" fromto="0 0 0 0 0 0.8"', Capsule(0.1, 0.8)),
    ],
)
def test_a_geom_is_a_visual_and_a_collision(written: str, geometry: object) -> None:
    part = link(read(body(f"<joint/><geom name='g' {written}/>")), "part")
    assert [(each.name, each.geometry) for each in part.visuals] == [("g", geometry)]
    assert [(each.name, each.geometry) for each in part.collisions] == [("g", geometry)]


def test_a_geom_that_touches_nothing_is_only_a_visual() -> None:
    part = link(read(body('<joint/><geom size="0.1" contype="0" conaffinity="0"/>')), "part")
    assert (len(part.visuals), len(part.collisions)) == (1, 0)


def test_a_geom_in_a_group_that_viewers_hide_is_only_a_collision() -> None:
    part = link(read(body('<joint/><geom size="0.1" group="3"/>')), "part")
    assert (len(part.visuals), len(part.collisions)) == (0, 1)


def test_a_material_gives_its_colour_to_a_geom_without_one() -> None:
    asset = '<asset><material name="red" rgba="1 0 0 1"/></asset>'
    geoms = '<geom size="0.1" material="red"/><geom size="0.1" material="red" rgba="0 0 1 1"/><geom size="0.1"/>'

    def color(visual: Visual) -> object:
        return visual.material and visual.material.rgba

    visuals = link(read(body(f"<joint/>{geoms}", asset)), "part").visuals
    assert [color(visual) for visual in visuals] == [(1, 0, 0, 1), (0, 0, 1, 1), (0.5, 0.5, 0.5, 1)]


@pytest.mark.parametrize(
    ("frictions", "expected", "words"),
    [
        ((), 1.0, ""),
        (("0.7",), 0.7, ""),
        (("0.7", "0.7 0.1"), 0.7, ""),
        (("0.7", "0.5"), 0.7, "not modelled: 1 <friction>"),
    ],
)
def test_the_friction_of_geoms_is_that_of_a_link_on_the_ground(
    frictions: tuple[str, ...], expected: float, words: str
) -> None:
    geoms = [f'<geom size="0.1" friction="{friction}"/>' for friction in frictions] or ['<geom size="0.1"/>']
    hidden = '<geom size="0.1" friction="9" contype="0" conaffinity="0"/>'
    text = body(f"<freejoint/>{''.join(geoms)}{hidden}")
    assert link(read(text), "part").contact == Contact(mu=expected)
    assert noted(text) == words
    assert link(read(text.replace("<freejoint/>", "<joint/>")), "part").contact is None


def test_the_ground_of_a_scene_is_no_part_of_the_robot() -> None:
    robot = read(body("<joint/>").replace("<worldbody>", '<worldbody><geom type="plane" size="1 1 1"/>'))
    assert link(robot, "world").collisions == ()


def test_a_shape_that_urdf_lacks_is_left_out_with_a_warning() -> None:
    plane = '<geom type="plane" size="1 1 1" contype="0" conaffinity="0"/>'
    found = reading(body(f'{plane}<body name="arm"><joint/><geom size="0.1"/></body>'))
    assert [each.code for each in found.diagnostics] == ["unknown-geometry"]
    assert found.robot is not None
    assert link(found.robot, "part").visuals == ()


@pytest.mark.parametrize(
    "attributes",
    [
        "",
        'scale="1 2 -1"',
        'scale="2 2 2" refpos="1 2 3" refquat="0.7 0.1 0.3 0.2"',
        'scale="1 2 3" refpos="1 2 3"',
    ],
)
def test_a_mesh_is_where_mujoco_has_it(attributes: str) -> None:
    """MuJoCo moves a mesh to its centre of mass and turns it; the numbers of the compiled geom count from there."""
    asset = f'<asset><mesh name="m" file="m.stl" {attributes}/></asset>'
    text = body('<joint pos="0.5 0 0"/><geom type="mesh" mesh="m" pos="1 2 3" euler="10 20 30"/>', asset)
    (visual,) = link(read(text, {"m.stl": stl()}), "part").visuals
    assert isinstance(visual.geometry, Mesh)
    assert visual.geometry.filename == "m.stl"
    rotation, place = map(np.array, pose(visual.origin))
    drawn = CORNERS * visual.geometry.scale @ rotation.T + place
    read_by_us = document(text, {"m.stl": stl()})
    model = mujoco.MjSpec.from_string(read_by_us.text, assets=read_by_us.contents).compile()
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.geom_quat[0])
    expected = model.mesh_vert @ turn.reshape(3, 3).T + model.geom_pos[0] - (0.5, 0, 0)
    gaps = np.linalg.norm(drawn[:, None] - expected[None], axis=2).min(axis=1)
    assert gaps.max() < 1e-5  # MuJoCo has corners in single precision


def test_a_mesh_that_urdf_cannot_place_is_left_out_with_a_warning() -> None:
    """URDF scales a mesh before it turns it."""
    asset = '<asset><mesh name="m" file="m.stl" scale="1 2 3" refquat="0.7 0.1 0.3 0.2"/></asset>'
    text = body('<joint/><geom type="mesh" mesh="m" contype="0" conaffinity="0"/>', asset)
    found = reading(text, {"m.stl": stl()})
    assert [each.code for each in found.diagnostics] == ["unknown-geometry"]


def test_a_mesh_is_named_from_the_folder_of_the_source() -> None:
    settings = '<compiler meshdir="../meshes"/><asset><mesh file="a/m.stl"/></asset>'
    text = body('<joint/><geom type="mesh" mesh="m"/>', settings)
    (visual,) = link(read(text, {"../meshes/a/m.stl": stl()}), "part").visuals
    assert isinstance(visual.geometry, Mesh)
    assert visual.geometry.filename == "../meshes/a/m.stl"


def test_a_mesh_that_gives_no_number_is_not_read_by_mujoco() -> None:
    asset = '<asset><mesh name="m" file="m.stl"/></asset>'
    geom = '<geom type="mesh" mesh="m"/>'
    robot = read(body(f"<joint/>{geom}", asset), {"m.stl": b"what our own readers of meshes refuse"})
    assert len(link(robot, "part").visuals) == 1
    weighed = world(f'<body name="part"><joint/>{geom}</body>', asset)
    with pytest.raises(TranslationError, match=r"m\.stl"):
        read(weighed, {"m.stl": b"no mesh"})
    assert link(read(weighed, {"m.stl": stl()}), "part").inertial is not None


def test_a_box_fitted_to_a_mesh_is_a_box() -> None:
    asset = '<asset><mesh name="m" file="m.stl"/></asset>'
    (visual,) = link(read(body('<joint/><geom type="box" mesh="m"/>', asset), {"m.stl": stl()}), "part").visuals
    assert isinstance(visual.geometry, Box)
