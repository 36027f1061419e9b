"""What the domain has to say of options is told at their lines in the configuration, and stops the robot if it must."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync import config
from urdfsync.diagnostics import ConfigError
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.rendering import Rendering
from urdfsync.outcome import Result

ROBOT = '[robots.{0}]\nsource = "ladder.json"\npackage = "{0}"\ndomain = "rcnetwork"\n{1}'


def run(project: Path, text: str) -> list[Result]:
    (project / "urdfsync.toml").write_text(text)
    loaded = config.load(Path("urdfsync.toml"))
    return list(build(loaded, loaded.robots, BuildOptions()))


def said(result: Result) -> list[str]:
    return [str(found) for found in result.diagnostics]


PROBLEM = "robot `A`: `prefix` names `in`, which is a node; choose another one [prefix-is-node]"


def test_an_error_stops_its_robot_alone(project: Path) -> None:
    one, other = run(project, ROBOT.format("A", 'prefix = "in"\n') + ROBOT.format("B", ""))
    assert (one.failed, said(one)) == (True, [f"urdfsync.toml:5: error: {PROBLEM}"])
    assert not (project / "modelica/A").exists()
    assert not other.failed
    assert (project / "modelica/B").exists()


def test_a_note_on_an_option_that_is_not_set_has_the_line_of_the_robot(project: Path) -> None:
    source = project / "ladder.json"
    source.write_text(source.read_text().replace('"ground"', '"earth"'))
    (result,) = run(project, ROBOT.format("A", ""))
    assert said(result) == ["urdfsync.toml:1: note: robot `A`: no node is called `ground` [no-ground]"]
    assert not result.failed
    (again,) = run(project, ROBOT.format("A", ""))
    assert again.in_step
    assert said(again) == []


def test_a_check_of_a_package_that_was_built_before_refuses_the_same(project: Path) -> None:
    run(project, ROBOT.format("A", ""))
    (project / "urdfsync.toml").write_text(ROBOT.format("A", 'prefix = "in"\n'))
    loaded = config.load(Path("urdfsync.toml"))
    with pytest.raises(ConfigError, match="prefix-is-node"):
        Rendering(loaded, loaded.robots[0], BuildOptions())
