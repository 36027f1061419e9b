"""Builds of URDF robots from end to end: equal bytes everywhere, notes, and errors that stop a build."""

from __future__ import annotations

from pathlib import Path

import pytest
from lxml import etree
from support.crashes import run
from support.replay import contents

from urdfsync.common.diagnostics import Severity


def test_the_order_of_elements_in_the_file_makes_no_difference(workspace: Path) -> None:
    run(workspace)
    before = contents(workspace / "modelica")
    source = workspace / "ws/src/six_axis_arm/six_axis_arm.urdf"
    tree = etree.parse(source)
    robot = tree.getroot()
    robot[:] = list(reversed(robot))
    tree.write(source)
    assert not any(action.writes for action in run(workspace, full=True).actions)
    assert contents(workspace / "modelica") == before


INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
CART = f"""<robot name="cart"><link name="base"/>
  <link name="tyre">{INERTIAL}</link><link name="roller">{INERTIAL}</link>
  <joint name="wheel" type="continuous"><parent link="base"/><child link="tyre"/></joint>
  <joint name="caster" type="continuous"><parent link="base"/><child link="roller"/></joint>
  <transmission name="t"><joint name="wheel"/></transmission>
</robot>"""
CART_CONFIGURATION = '[robots.cart]\nsource = "cart.urdf"\npackage = "Cart"\n'


@pytest.fixture
def cart(tmp_path: Path) -> Path:
    """A project that builds a robot with a wheel and a caster."""
    (tmp_path / "cart.urdf").write_text(CART)
    (tmp_path / "urdfsync.toml").write_text(CART_CONFIGURATION)
    return tmp_path


def test_passive_joints_are_noted(cart: Path) -> None:
    (note,) = run(cart).diagnostics
    assert (note.severity, note.code, Path(note.file).name, note.line) == (
        *(Severity.NOTE, "passive-joints"), "urdfsync.toml", 1
    )  # fmt: skip
    assert note.message.startswith("robot `cart`: Run and Test do not drive `caster`: ")
    assert run(cart).diagnostics == (note,)
    (cart / "urdfsync.toml").write_text(CART_CONFIGURATION + 'driven = ["wheel"]\n')
    assert not run(cart).diagnostics


def test_a_package_inside_of_the_library_does_not_need_it(cart: Path) -> None:
    (cart / "modelica/UrdfSync").mkdir(parents=True)
    top = cart / "modelica/UrdfSync/package.mo"
    top.write_text('package UrdfSync\n  annotation (uses(Modelica(version="4.1.0")));\nend UrdfSync;\n')
    (cart / "urdfsync.toml").write_text(CART_CONFIGURATION.replace('"Cart"', '"UrdfSync.Cart"'))
    assert [found.code for found in run(cart).diagnostics] == ["passive-joints"]


def test_a_link_that_goes_with_its_frame_stops_the_build_too(cart: Path) -> None:
    """The configuration was right until the source lost the link."""
    (cart / "urdfsync.toml").write_text(CART_CONFIGURATION + 'frames = ["tyre"]')
    assert not run(cart).failed
    before = contents(cart / "modelica")
    (cart / "cart.urdf").write_text(CART.replace("tyre", "tire"))
    (error,) = run(cart).diagnostics
    assert (error.code, error.line, error.hint) == ("frame-of-no-link", 4, "did you mean `tire`?")
    assert contents(cart / "modelica") == before


def test_the_new_name_of_a_class_has_a_capital_although_that_of_its_element_has_none(cart: Path) -> None:
    run(cart)
    (cart / "Bench.mo").write_text("model Bench\n  Cart.Joints.Caster caster;\nend Bench;\n")
    (cart / "cart.urdf").write_text(CART.replace('"caster"', '"swivel"'))
    (found,) = (found for found in run(cart).diagnostics if found.code == "unresolved")
    assert (found.hint, found.line) == ("use `Swivel` instead", 2)
