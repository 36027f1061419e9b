"""Builds of URDF robots from end to end: meshes that come and go, same bytes everywhere, edits that stay."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from lxml import etree
from support.crashes import run
from support.replay import contents

from urdfsync.diagnostics import Severity

SAMPLES = Path(__file__).parents[1] / "modelica" / "UrdfSync" / "Resources" / "robots"
CONFIGURATION = """
[robots.arm]
source = "ws/src/six_axis_arm/six_axis_arm.urdf"
package = "Arm"
ignore = ["not-modelled"]
"""


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    """A project that builds the sample arm from a ROS workspace of its own."""
    shutil.copytree(SAMPLES / "six_axis_arm", tmp_path / "ws" / "src" / "six_axis_arm")
    (tmp_path / "urdfsync.toml").write_text(CONFIGURATION)
    return tmp_path


def test_the_order_of_elements_in_the_file_makes_no_difference(arm: Path) -> None:
    run(arm)
    before = contents(arm / "modelica")
    source = arm / "ws/src/six_axis_arm/six_axis_arm.urdf"
    tree = etree.parse(source)
    robot = tree.getroot()
    robot[:] = list(reversed(robot))
    tree.write(source)
    assert not any(action.writes for action in run(arm, full=True).actions)
    assert contents(arm / "modelica") == before


def test_meshes_are_imported_and_named_by_modelica_uris(arm: Path) -> None:
    run(arm)
    resources = {p.name for p in (arm / "modelica/Arm/Resources").iterdir()}
    texts = "".join(p.read_text() for p in (arm / "modelica/Arm/Links").glob("*Parameters.mo"))
    assert len(resources) == 7
    assert all(f'"modelica://Arm/Resources/{name}"' in texts for name in resources)
    assert "package://" not in texts


def test_outermost_points_of_meshes_are_found_once_the_robot_touches_the_ground(arm: Path) -> None:
    """Whether the meshes are there or not, what is built in the end is what one build makes of it."""
    run(arm)
    assert '"hull"' not in (arm / ".urdfsync/robots/arm.state").read_text()
    meshes = arm / "ws/src/six_axis_arm/meshes"
    meshes.rename(arm / "away")
    floating = CONFIGURATION + 'base = "floating"\n'
    (arm / "urdfsync.toml").write_text(floating)
    (error,) = run(arm).diagnostics
    assert (error.severity, error.code) == (Severity.ERROR, "lost-state")
    assert error.message.endswith("the record of its imported copy is incomplete")
    (arm / "away").rename(meshes)
    run(arm)
    assert '"hull"' in (arm / ".urdfsync/robots/arm.state").read_text()
    found = contents(arm / "modelica")
    shutil.rmtree(arm / "modelica")
    shutil.rmtree(arm / ".urdfsync")
    run(arm)
    assert contents(arm / "modelica") == found
    (arm / "urdfsync.toml").write_text(CONFIGURATION)
    run(arm)
    assert '"hull"' not in (arm / ".urdfsync/robots/arm.state").read_text()


def test_meshes_of_a_modelica_library_are_imported(arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The library on MODELICAPATH comes before a folder of its name beside the source."""
    folder = arm / "ws" / "src" / "six_axis_arm"
    source = folder / "six_axis_arm.urdf"
    source.write_text(source.read_text().replace("package://six_axis_arm/meshes/", "modelica://ArmMeshes/Resources/"))
    library = arm / "libraries" / "ArmMeshes 1.2.0"
    library.mkdir(parents=True)
    (library / "package.mo").write_text("package ArmMeshes\nend ArmMeshes;\n")
    shutil.move(folder / "meshes", library / "Resources")
    monkeypatch.setenv("MODELICAPATH", "")
    result = run(arm)
    assert {found.code for found in result.diagnostics} == {"mesh-not-found"}
    assert "`ArmMeshes` on MODELICAPATH" in (result.diagnostics[0].hint or "")
    monkeypatch.setenv("MODELICAPATH", str(arm / "libraries"))
    assert run(arm).diagnostics == ()
    assert len(list((arm / "modelica/Arm/Resources").iterdir())) == 7
    beside = folder / "ArmMeshes" / "Resources"
    shutil.copytree(library / "Resources", beside)
    (beside / "carousel.obj").write_text("no mesh")
    assert run(arm).in_step
    monkeypatch.setenv("MODELICAPATH", "")
    assert {found.code for found in run(arm).diagnostics} == {"mesh-unreadable-kept"}


def test_missing_meshes_are_one_warning_for_each_package(arm: Path) -> None:
    shutil.rmtree(arm / "ws/src/six_axis_arm/meshes")
    source = arm / "ws/src/six_axis_arm/six_axis_arm.urdf"
    text = source.read_text()
    source.write_text(text.replace("package://six_axis_arm/meshes/carousel.obj", "package://turntable/carousel.obj"))

    def told(full: bool = False) -> list[str]:
        return [str(found).partition(": ")[2] for found in run(arm, full=full).diagnostics]

    warnings = [
        "warning: 6 meshes (such as `package://six_axis_arm/meshes/base_casting.stl`) not found; left out; "
        "put it into the package `six_axis_arm`, or add the folder that holds that to `package_paths` [mesh-not-found]",
        "warning: mesh `package://turntable/carousel.obj` not found; left out; "
        "put it into the package `turntable`, or add the folder that holds that to `package_paths` [mesh-not-found]",
    ]
    assert told() == warnings
    source.write_text(source.read_text().replace('<mass value="', '<mass value="1'))
    *others, jump = told()
    assert others == warnings
    assert jump.startswith("warning: link drive_pinion: its mass jumps, 0.045 kg → 10.045 kg (and 5 more like it); ")
    assert told(full=True) == warnings


def test_meshes_from_a_folder_of_another_name_are_one_warning_for_each_package(arm: Path) -> None:
    (arm / "ws/src/six_axis_arm").rename(arm / "ws/src/arm-main")
    (arm / "urdfsync.toml").write_text(CONFIGURATION.replace("ws/src/six_axis_arm/", "ws/src/arm-main/"))
    (found,) = run(arm).diagnostics
    assert (found.severity, found.code) == (Severity.WARNING, "mesh-guessed")
    assert found.message == (
        "7 meshes (such as `package://six_axis_arm/meshes/base_casting.stl`) are taken from a folder that is not "
        "called like the package `six_axis_arm`"
    )
    for mesh in (arm / "ws/src/arm-main/meshes").iterdir():
        if mesh.name != "carousel.obj":
            mesh.unlink()
    said = {found.code: found.message for found in run(arm).diagnostics}
    assert "`package://six_axis_arm/meshes/carousel.obj` is taken from" in said["mesh-guessed"]


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
    (cart / "modelica/Cart/Bench.mo").write_text("within Cart;\nmodel Bench\n  Joints.Caster caster;\nend Bench;\n")
    (cart / "cart.urdf").write_text(CART.replace('"caster"', '"swivel"'))
    (found,) = (found for found in run(cart).diagnostics if found.code == "unresolved")
    assert (found.hint, found.line) == ("use `Swivel` instead", 3)
