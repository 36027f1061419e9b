"""The files of a generated package: the golden texts, and what holds for every robot."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pymoca.parser
import pytest
from support import urdfs
from support.golden import GOLDEN, TARGETS, TEMPLATES, VARIANTS, expected, golden, on_disk
from support.loops import FOUR_BAR
from support.modelica import compile_task, execute
from support.packages import Package, generate

from urdfsync.domain import Artifact, Order, Role, Target
from urdfsync.formats.urdf.artifacts import artifacts
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Dynamics, Joint, Link, Robot
from urdfsync.modelica.parser import parse


def package_of(*elements: str, package: str = "Own", **options: Any) -> Package:
    return generate(urdfs.robot(*elements).encode(), Target(package, package.rpartition(".")[2]), **options)


def test_golden_files_are_what_the_templates_write() -> None:
    """Of the library's links and joints and of its Examples, nothing else is on disk."""
    files, generated = on_disk(), expected()
    differing = {path for path in files.keys() | generated.keys() if files.get(path) != generated.get(path)}
    assert differing == set(), "run `python -m tests --renew` and review what it wrote"


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_golden_files_are_modelica(variant: str, tmp_path: Path) -> None:
    """To the compiler, to another parser, and to our own."""
    rumoca = pytest.importorskip("rumoca")
    folder = golden(variant).write(tmp_path)
    models = [path.read_text("utf-8") for path in (GOLDEN / variant).rglob("*.mo")]
    assert None not in [pymoca.parser.parse(text, bypass_cache=True) for text in models]
    assert {path.name: found for path in folder.rglob("*.mo") if (found := rumoca.validate(str(path)))} == {}
    assert [path for path, text in golden(variant).models.items() if parse(text).faults] == []


@pytest.mark.slow
def test_one_of_everything_compiles(tmp_path: Path, modelica_library: Path) -> None:
    """Run of the one on a fixed base, Test of the one that can go anywhere."""
    targets = {"fixed": Target("Bolted", "Bolted"), "floating": Target("Free", "Free")}
    packages = {name: generate(GOLDEN / "menagerie.urdf", target, base=name) for name, target in targets.items()}
    folders = [package.write(tmp_path) for package in packages.values()]
    tasks = [compile_task(model) for model in ("Bolted.BoltedRun", "Free.FreeTest")]
    assert [outcome.error for outcome in execute(modelica_library, folders, tasks)] == ["", ""]


def test_every_template_is_in_use() -> None:
    both = Options(approach=("package", "record"))
    mobile = Options(base="floating")
    begun = Robot("r", (Link("a"), Link("b")), (Joint("a", "continuous", "a", "b", start=0.5),))
    robots = (
        (begun, both),
        (Robot("r", begun.links, (Joint("a", "ball", "a", "b", dynamics=Dynamics(1.0)),)), both),
        (FOUR_BAR, Options()),
        (golden("fixed").robot, both),
        (golden("record").robot, both),
        (golden("record").robot, mobile),
    )
    made = [each for robot, options in robots for each in artifacts(robot, {}, TARGETS["menagerie"], options)]
    used = {each.template for each in made if isinstance(each, Artifact)}
    for path in TEMPLATES.rglob("*.jinja"):
        used.update(re.findall(r'<%-? (?:import|include) "([^"]+\.jinja)"', path.read_text(encoding="utf-8")))
    assert used == {path.relative_to(TEMPLATES).as_posix() for path in TEMPLATES.rglob("*.jinja")}


@pytest.mark.parametrize(("inputs", "words"), [
    ("names", 'RealInput a_phi(unit = "rad", start = robot.a_joint.phi_start)'),
    ("vector", '(unit = {"rad", "rad"}, start = {robot.a_joint.phi_start, 0})'),
])  # fmt: skip
def test_a_start_position_stands_in_a_record_and_the_models_begin_there(inputs: str, words: str) -> None:
    made = package_of(
        *map(urdfs.link, "abc"),
        urdfs.joint("a_joint", "continuous", "a", "b"),
        urdfs.joint("b_joint", "continuous", "a", "c"),
        start={"a_joint": 0.5},
        inputs=inputs,
        approach=("package", "record"),
    ).texts
    assert "Modelica.Units.SI.Angle a_joint = 0.5\n" in made["OwnStart.mo"]
    assert made["Own.mo"].count("phi_start = startPositions.a_joint,") == 2
    assert words.replace("a_phi", "a_joint_phi") in made["OwnRun.mo"]
    assert "startPositions.a_joint,\n" in made["OwnGeneric.mo"]
    assert "OwnStart\n" in made["package.order"]


def test_roles_and_owners() -> None:
    robot = Robot("r", (Link("a"), Link("b")), (Joint("a-b", "fixed", "a", "b"),))
    options = Options(approach=("package", "record"), base="floating")
    files = {each.path: each for each in artifacts(robot, {}, Target("R", "R"), options)}
    found = {path: (each.role, each.owner) for path, each in files.items() if isinstance(each, Artifact)}
    assert found["Links/A.mo"] == (Role.MODEL, "link a")
    assert found["Links/AParameters.mo"] == (Role.RECORD, "link a")
    assert found["Joints/A__b.mo"] == (Role.MODEL, "joint a-b")
    assert found["R.mo"] == found["RRun.mo"] == found["RTest.mo"] == (Role.MODEL, "robot")
    assert found["RStance.mo"] == found["RParameters.mo"] == (Role.RECORD, "robot")
    assert found["package.mo"] == found["Links/package.mo"] == (Role.PACKAGE, "robot")
    order = ("R", "RRun", "RTest", "RGeneric", "RStance", "RParameters", "Links", "Joints")
    assert files["package.order"] == Order("package.order", order)


@pytest.mark.parametrize(("package", "uses"), [("Own", ["Modelica", "UrdfSync"]), ("Plant.Robots.Own", [])])
def test_a_package_at_the_top_says_what_it_uses(package: str, uses: list[str]) -> None:
    made = package_of(urdfs.link("a"), package=package)
    text = made.texts["package.mo"]
    assert re.findall(r"(\w+)\(version ?=", text) == uses
    assert text.startswith(f"within {package.rpartition('.')[0]};")


def test_a_robot_without_any_mass_has_a_body_in_its_root_link() -> None:
    """The frames of a Modelica model need a root, and that is a body."""
    made = package_of(urdfs.link("a"), urdfs.link("b"), urdfs.joint("turn", "revolute", "a", "b"), package="Bot")
    texts = {path: text for path, text in made.texts.items() if path.startswith("Links/")}
    assert "hasInertial = false" not in texts["Links/AParameters.mo"]
    assert "hasInertial = false" in texts["Links/BParameters.mo"]
