"""What is hardly meant is one warning at its line; robots that are only unusual have none."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support.corpus import FOLDER, robots
from support.packages import read
from support.urdfs import joint, limit, link, mimic, robot

from urdfsync.formats.urdf import plausibility

BASE, ARM = link("base", 4.0), link("arm", 2.0)


def body(mass: float, inertia: float, *shapes: str, name: str = "arm", xyz: str = "0 0 0") -> str:
    tensor = f'<inertia ixx="{inertia}" iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/>'
    inertial = f'<inertial><origin xyz="{xyz}"/><mass value="{mass}"/>{tensor}</inertial>'
    visuals = "".join(f"<visual>{shape}</visual>" for shape in shapes)
    return f'<link name="{name}">{inertial}{visuals}</link>'


def shape(geometry: str, xyz: str = "0 0 0") -> str:
    return f'<origin xyz="{xyz}"/><geometry>{geometry}</geometry>'


def turn(*inside: str, kind: str = "revolute", xyz: str = "0 0 1", rpy: str = "0.5 -0.6 0.7") -> str:
    return joint("j", kind, "base", "arm", xyz=xyz, rpy=rpy, axis="0 0 1", inside=inside)


BALL, MESH = '<sphere radius="0.1"/>', '<mesh filename="package://p/a.stl"/>'


@pytest.mark.parametrize(("elements", "code", "line"), [
    ([link("base"), link("arm"), turn()], "no-inertia", 2),
    ([BASE, link("arm"), turn()], "no-inertia", 5),
    ([body(400, 1, name="base"), body(200, 1), turn(xyz="0 0 0.3")], "mass-unit", 2),
    ([BASE, body(1, 0.1, shape(BALL)), turn()], "inertia-size", 4),
    ([BASE, body(1, 4e3, shape(MESH)), turn()], "inertia-size", 4),
    ([BASE, body(1, 4e3), turn()], "inertia-size", 4),
    ([BASE, body(1, 0, shape(MESH)), turn()], "inertia-size", 4),
    ([BASE, ARM, turn(xyz="0 0 300")], "length-unit", 5),
    ([BASE, ARM, turn(limit(0, 300), kind="prismatic")], "length-unit", 5),
    ([BASE, ARM, turn(limit(-90, 90))], "angle-unit", 5),
    ([BASE, ARM, turn(limit(0, 720))], "angle-unit", 5),
    ([BASE, ARM, turn(rpy="90 0 45")], "angle-unit", 5),
    ([BASE, ARM, turn(limit(0, 0))], "zero-limits", 5),
    ([BASE, ARM, turn(limit(velocity=0))], "zero-limits", 5),
    ([BASE, ARM, turn('<limit effort="0" velocity="0"/>', kind="continuous")], "zero-limits", 5),
    ([BASE, body(1, 0.1, shape(MESH, "0 12 0")), turn()], "shape-far", 4),
    ([BASE, body(2, 0), turn()], "inertia-size", 4),
    ([BASE, body(2, 1e-18), turn()], "inertia-size", 4),
    ([BASE, body(2, 0.1, xyz="11 0 0"), turn()], "center-of-mass", 4),
    ([BASE, body(2, 0.1, shape(MESH), xyz="400 0 0"), turn()], "center-of-mass", 4),
    ([BASE, body(2, 0.002, shape(BALL), xyz="0 0 0.7"), turn()], "center-of-mass", 4),
    ([BASE, body(30, 0.02, shape('<box size="0.1 0.1 0.1"/>')), turn()], "density", 4),
    ([BASE, body(0.1, 0.01, shape('<box size="1 1 1"/>')), turn()], "density", 4),
    ([BASE, ARM, turn(limit(effort=0)), link("c", 1), joint("k", "revolute", "arm", "c")], "zero-effort", 5),
    ([BASE, ARM, turn(limit(), '<safety_controller k_velocity="1" soft_lower_limit="-4" soft_upper_limit="2"/>')],
     "soft-limits", 5),
    ([BASE, ARM, turn(limit(), '<safety_controller k_velocity="1" soft_lower_limit="-120" soft_upper_limit="-3"/>')],
     "soft-limits", 5),
    ([BASE, ARM, turn(limit(), kind="continuous")], "limit-without-effect", 5),
    ([BASE, ARM, joint("k", "revolute", "arm", "c", inside=[limit(-1, 2), mimic("j", -1)]),
      turn(limit(-1, 2)), link("c", 1)], "mimic-limits", 5),
])  # fmt: skip
def test_what_is_hardly_meant_is_a_warning(elements: list[str], code: str, line: int) -> None:
    text = robot(*elements)
    reading = read(text.encode())
    assert reading.snapshot is not None
    assert [(str(d.severity), d.code) for d in reading.diagnostics] == [("warning", code)]
    (found,) = reading.diagnostics
    named = {"no-inertia": 'name="j"' if line == 5 else "<robot", "mass-unit": "<robot"}
    assert named.get(code, "<link" if line == 4 else "<joint") in text.split("\n")[found.line - 1]
    assert found.hint


@pytest.mark.parametrize("elements", [
    [link("base"), link("tool"), joint("mount", "fixed", "base", "tool")],
    [link("world"), link("x"), ARM, joint("a", "prismatic", "world", "x"), joint("b", "prismatic", "x", "arm")],
    [BASE, link("tool"), ARM, joint("mount", "fixed", "arm", "tool"), turn()],
    [BASE, body(1, 0.004, shape(BALL)), turn()],
    [BASE, body(1, 0.1, shape('<box size="0.001 0.001 0.001"/>')), turn()],
    [BASE, body(1e-4, 0, shape(MESH)), turn()],
    [BASE, body(1, 0, xyz="0.3 0 0"), turn()],
    [BASE, body(1, 0.1, shape(MESH), xyz="0 0 1.5"), turn()],
    [BASE, body(1, 0.02, shape(BALL), xyz="0 0 0.3"), turn()],
    [BASE, body(1, 0), joint("j", "fixed", "base", "arm")],
    [body(0, 0, name="base"), ARM, turn()],
    [BASE, body(8, 0.01, shape('<box size="0.1 0.1 0.1"/>')), turn()],
    [BASE, body(0.2, 2e-5, shape('<sphere radius="0.01"/>')), turn(xyz="0 0 0.01")],
    [BASE, ARM, turn(limit(), '<safety_controller k_velocity="1" soft_lower_limit="-2" soft_upper_limit="3.0001"/>')],
    [BASE, ARM, turn(limit(), '<safety_controller k_velocity="1" soft_lower_limit="-20" soft_upper_limit="20"/>')],
    [BASE, ARM, turn(limit(), '<safety_controller k_velocity="1"/>')],
    [BASE, ARM, turn(limit(-1e16, 1e16), kind="continuous")],
    [BASE, ARM, link("c", 1), turn(limit(-1, 2)), joint("k", "revolute", "arm", "c", inside=[limit(), mimic("j", -1)])],
    [BASE, ARM, link("c", 1), turn(kind="continuous"), joint("k", "revolute", "arm", "c", inside=[mimic("j")])],
    [BASE, ARM, turn(limit(-7.33, 7.33))],
    [BASE, ARM, turn(limit(-62.831853, 62.831853))],
    [BASE, ARM, turn(limit(-1e9, 1e9))],
    [BASE, ARM, turn(limit(0, 15), kind="prismatic")],
    [link("base"), link("y"), ARM, joint("a", "prismatic", "base", "y", inside=[limit(-1000, 1000)]),
     joint("b", "fixed", "y", "arm")],
    [BASE, ARM, turn(limit(effort=0))],
    [BASE, body(1, 0.1, shape(MESH, "0 1.9 0")), turn(xyz="0 0 0.1")],
    [body(2000, 500, shape('<box size="4 2 1"/>'), name="base")],
])  # fmt: skip
def test_what_is_only_unusual_is_none(elements: list[str]) -> None:
    assert read(robot(*elements).encode()).diagnostics == ()


def test_a_frame_has_no_collision_shape() -> None:
    base = body(0, 0, name="base").replace("</link>", f"<collision>{shape(BALL)}</collision></link>")
    (found,) = read(robot(base, ARM, turn()).encode()).diagnostics
    assert (found.code, found.line) == ("no-inertia", 3)
    assert "'base' has a mass of 0 and a collision shape" in found.message


def test_an_impossible_density_is_told_with_the_likely_mass() -> None:
    cube = shape('<box size="0.1 0.1 0.2"/>')
    masses = {"base": 7, "arm": 42.87, "hand": 6}
    links = [body(mass, 0.002 * mass, cube, name=name) for name, mass in masses.items()]
    (found,) = read(robot(*links, turn(), joint("k", "revolute", "arm", "hand")).encode()).diagnostics
    assert "42.87 kg in shapes of 2 l are 21,435 kg/m³; as dense as other links, it would have 7 kg" in found.message


FILLED_IN = (
    # Inertias that somebody filled in, 1e-3 or 1e-2 kg·m², of links of some millimetres and grams.
    *("atlas/urdf/robotiq", "robotisOpenManipulator", "open_manipulator", "open_manipulator_robot"),
    *("robotisTurtleBot3Burger", "turtlebot3_burger", "turtlebot3_burger_for_autorace", "schunk_pg70"),
    "turtlebot3_burger_for_autorace_2020",
    "al5d_robot",  # links of 80 to 200 g without any
)
MASSLESS = (
    *("lbr_iiwa_14_r820", "puma560_robot", "irb6640_185_280", "irb7600_150_350"),
    *("m430ia2f", "m430ia2p", "m900ib700"),
)
_SOURCES = Path(plausibility.__file__).parent.glob("*.py")
CODES = {code for file in _SOURCES for code in re.findall(r'Finding\("([a-z-]+)"', file.read_text(encoding="utf-8"))}


@pytest.mark.usefixtures("corpus")
@pytest.mark.parametrize("file", robots())
def test_real_robots(file: str) -> None:
    """Judged by hand: each finding is a fault of the file."""
    found = {one.code for one in read((FOLDER / file).read_bytes()).diagnostics} & CODES
    expected = {
        "inertia-size": FILLED_IN,
        "no-inertia": MASSLESS,
        "mimic-limits": ("onrobot_rg2_model",),
        **dict.fromkeys(("not-mirrored", "collision-beside", "inertia-shape"), ("robotisOP2",)),
    }
    assert found == {c for c, names in expected.items() if file.endswith(tuple(f"/{name}.urdf" for name in names))}
