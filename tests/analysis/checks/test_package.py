"""The folder in which a compiler finds one package and what it refers to."""

from __future__ import annotations

import codecs
from pathlib import Path

import pytest

from urdfsync.analysis.checks import package as files
from urdfsync.project import config
from urdfsync.project.config import Config, RobotConfig

CONFIG = "".join(
    f'[robots.{name}]\nsource = "{name}.json"\npackage = "Plant.Robots.{name.title()}"\ndomain = "rcnetwork"\n'
    for name in ("arm", "cart", "crane")
)


def write(folder: Path, **texts: str) -> None:
    for name, text in texts.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.fixture
def plant(rc_domain: None, tmp_path: Path) -> Config:
    """Three robots and a controller in one top-level package."""
    output = tmp_path / "modelica"
    write(
        output,
        **{
            "Plant/package.mo": "package Plant",
            "Plant/package.order": "Robots\nControl\n",
            "Plant/Control.mo": "block Control",
            "Plant/Resources/Old.mo": "no class",
            "Plant/.git/Hidden.mo": "no class",
            "Plant/.#Control.mo": "what an editor leaves",
            "Plant/Robots/package.mo": "package Robots",
            "Plant/Robots/Arm/package.mo": "package Arm",
            "Plant/Robots/Arm/Arm.mo": "model Arm",
            "Plant/Robots/Cart/package.mo": "package Cart",
            "Plant/Robots/Crane/package.mo": "package Crane",
            "Plant/Robots/Crane/Hook.mo": "model Hook",
            "Other/package.mo": "package Other",
        },
    )
    return config.parse(CONFIG, tmp_path / "urdfsync.toml", "urdfsync.toml")


def robot(plant: Config, name: str) -> RobotConfig:
    return next(robot for robot in plant.robots if robot.name == name)


def test_other_robots_are_left_out(plant: Config) -> None:
    found = files.files_around(plant, robot(plant, "arm"), {"Arm.mo": b"model Arm"})
    expected = {"Plant/package.mo", "Plant/package.order", "Plant/Control.mo", "Plant/Robots/package.mo"}
    assert found.keys() == expected


def test_a_robot_that_is_mentioned_is_there_also_if_another_mentions_it(plant: Config) -> None:
    write(plant.root / "modelica", **{"Plant/Robots/Cart/Load.mo": "Crane.Hook hook;"})
    found = files.files_around(plant, robot(plant, "arm"), {"Arm.mo": b"Plant.Robots.Cart cart;"})
    assert {"Plant/Robots/Cart/Load.mo", "Plant/Robots/Crane/Hook.mo"} <= found.keys()


def test_packages_around_that_do_not_exist_are_made_up(rc_domain: None, tmp_path: Path) -> None:
    plant = config.parse(CONFIG, tmp_path / "urdfsync.toml", "urdfsync.toml")
    found = files.files_around(plant, robot(plant, "arm"), {})
    assert found == {
        "Plant/package.mo": b"within;\npackage Plant\nend Plant;\n",
        "Plant/Robots/package.mo": b"within Plant;\npackage Robots\nend Robots;\n",
    }


def test_a_package_is_written_where_its_name_says_without_byte_order_marks(plant: Config, tmp_path: Path) -> None:
    texts = {"Arm.mo": codecs.BOM_UTF8 + b"model Arm"}
    root = files.write_package(tmp_path / "work", robot(plant, "arm"), texts, {"Plant/package.mo": b"package Plant"})
    assert root == tmp_path / "work" / "Plant"
    assert (root / "Robots/Arm/Arm.mo").read_bytes() == b"model Arm"
    assert (root / "package.mo").read_bytes() == b"package Plant"


@pytest.mark.parametrize(("text", "expected"), [
    ("within; // model\n\nencapsulated model Own end Own;", ["Own"]),
    ("final block Own end Own;", ["Own"]),
    ("model Own = Arm(n = 2);", ["Own"]),
    ("model Own partial model In end In; end Own;", ["Own"]),
    ("encapsulated partial model Own end Own;", []),
    ("function Own end Own;", []),
    ("package Own model In end In; end Own;", ["Own.In"]),
    ("model Other end Other;", []),
    ("within Plant.Robots", []),
    ("model", []),
    ("", []),
])  # fmt: skip
def test_models_and_blocks_that_are_not_partial_compile_by_themselves(
    plant: Config, text: str, expected: list[str]
) -> None:
    file = plant.root / "modelica/Own.mo"
    assert files.users_models(robot(plant, "arm"), {file: text.encode()}).files == dict.fromkeys(expected, file)


def test_so_do_those_in_the_package(plant: Config) -> None:
    folder = plant.root / "modelica/Plant/Robots/Arm"
    own = {
        folder / "Own.mo": b"within Plant.Robots.Arm;\nmodel Own\nend Own;\n",
        folder / "Control/PID.mo": b"within Plant.Robots.Arm.Control; block PID\nend PID;\n",
        folder / "Control/package.mo": b"within Plant.Robots.Arm;\npackage Control\nend Control;\n",
    }
    found = files.users_models(robot(plant, "arm"), own)
    assert {*found.files} == {"Plant.Robots.Arm.Own", "Plant.Robots.Arm.Control.PID"}
    assert (found.libraries, found.left_out) == ({}, ())
