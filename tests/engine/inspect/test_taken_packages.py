"""Robots that take each other's packages: edits stay with their robots."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import edit
from support.urdfs import robot_of

CONFIGURATION = """\
[defaults]
create_parents = true

[robots.a]
source = "a.urdf"
package = "Plant.A"

[robots.b]
source = "b.urdf"
package = "Plant.B"
"""


@pytest.fixture(autouse=True)
def robots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> None:
    """Two robots that differ in masses, each with an edit."""
    monkeypatch.chdir(tmp_path)
    Path("urdfsync.toml").write_text(CONFIGURATION)
    for name, mass in (("a", 1.1), ("b", 2.2)):
        Path(f"{name}.urdf").write_text(robot_of(f"1 {mass}"))
    execute("build")
    for name in "ab":
        edit(link_of(name), "\nequation", f"\n  Real of_{name};\n\nequation")
    execute("build")


def link_of(package: str) -> Path:
    return Path(f"modelica/Plant/{package.upper()}/Links/Link_1.mo")


def name_packages(**names: str) -> None:
    """Give robots other packages, by robot."""
    text = CONFIGURATION
    for robot, name in names.items():
        text = text.replace(f'"{robot}.urdf"\npackage = "Plant.{robot.upper()}"', f'"{robot}.urdf"\npackage = "{name}"')
    Path("urdfsync.toml").write_text(text)


def test_exchanged_packages_are_refused_until_one_has_a_third_name(execute: Execute) -> None:
    name_packages(a="Plant.B", b="Plant.A")
    before = {path: path.read_bytes() for path in Path().rglob("*") if path.is_file() and "deps" not in path.parts}
    for command in (["build", "-n"], ["build", "--check"], ["status"], ["build"]):
        printed = execute(*command, code=2)
        assert "robot `a`: its package is so far that of robot `b`, with its edits; build `b` first" in printed.err
        assert "robot `b`: its package is so far that of robot `a`" in printed.err
    assert {path: path.read_bytes() for path in before} == before
    name_packages(a="Plant.C")
    execute("build", "a")
    name_packages(a="Plant.C", b="Plant.A")
    execute("build", "b")
    name_packages(a="Plant.B", b="Plant.A")
    execute("build")
    assert "of_a" in link_of("b").read_text()
    assert "of_b" in link_of("a").read_text()
    execute("build", "--check")


def test_a_chain_is_built_from_its_end(execute: Execute) -> None:
    name_packages(a="Plant.B", b="Plant.C")
    execute("build", code=2)
    execute("build")
    assert "of_a" in link_of("b").read_text()
    assert "of_b" in link_of("c").read_text()
    execute("build", "--check")


def test_a_package_is_not_taken_while_the_other_state_is_unreadable(execute: Execute) -> None:
    state = Path(".urdfsync/robots/b.state")
    state.write_text(re.sub(r'"release":"[^"]*"', '"release":"99.0"', state.read_text()))
    name_packages(a="Plant.B", b="Plant.C")
    before = {path: path.read_bytes() for path in Path("modelica").rglob("*") if path.is_file()}
    printed = execute("build", code=2)
    assert "a: 1 error, nothing was changed" in printed.err
    assert "urdfsync 99.0 wrote this state" in printed.err
    assert {path: path.read_bytes() for path in Path("modelica").rglob("*") if path.is_file()} == before
