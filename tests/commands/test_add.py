"""`urdfsync add`: one more robot, and nothing of the configuration is lost."""

from __future__ import annotations

import codecs
import errno
from pathlib import Path

import pytest
from support.commands import Execute
from support.crashes import Operation, before_each
from support.files import unchanged

from urdfsync.project import config

ADD = ("add", "--domain", "rcnetwork")


def test_a_robot_joins(project: Path, execute: Execute) -> None:
    file = project / "urdfsync.toml"
    before = f"# mine\n{file.read_text().rstrip()}"  # without an end of the last line
    file.write_text(before)
    (project / "new").mkdir()
    (project / "new/Ladder.json").write_text((project / "ladder.json").read_text())
    assert execute(*ADD, "new/Ladder.json").lines == [
        "urdfsync.toml extended",
        "  ladder2: new/Ladder.json becomes package Ladder2",
        "    ground = true  guessed: a node is named ground",
        "Look it over, then run `urdfsync build`.",
    ]
    assert file.read_text().startswith(f"{before}\n\n[robots.ladder2]\n")
    execute("build", "-q")
    assert (project / "modelica/Ladder2/package.mo").is_file()


def test_line_ends_and_a_byte_order_mark_stay(project: Path, execute: Execute) -> None:
    file = project / "urdfsync.toml"
    file.write_bytes(codecs.BOM_UTF8 + file.read_bytes().replace(b"\n", b"\r\n"))
    (project / "other.json").write_text((project / "ladder.json").read_text())
    execute(*ADD, "other.json", "-q")
    assert file.read_bytes().count(b"\n") == file.read_bytes().count(b"\r\n")
    assert file.read_bytes().startswith(codecs.BOM_UTF8)


def test_what_does_not_fit_changes_nothing(project: Path, execute: Execute) -> None:
    (project / "other.json").write_text((project / "ladder.json").read_text())
    with unchanged(project):
        assert "is the source of `ladder` already" in execute(*ADD, "ladder.json", code=2).err
        assert "nowhere.json" in execute(*ADD, "nowhere.json", code=2).err
    file = project / "urdfsync.toml"
    file.write_text('robots = { ladder = { domain = "rcnetwork", source = "ladder.json", package = "Ladder" } }\n')
    with unchanged(project):
        assert "[toml-syntax]" in execute(*ADD, "other.json", code=2).err


def write_fleet(folder: Path) -> str:
    """A xacro that is several robots, one of which has a name of its own."""
    parts = ['<xacro:arg name="kind" default="s"/>', '<link name="$(arg kind)"/>']
    head = '<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    (folder / "robot.urdf.xacro").write_text(f"{head}{''.join(parts)}</robot>")
    return "robot.urdf.xacro"


@pytest.mark.slow
def test_one_xacro_is_many_robots(folder: Path, execute: Execute) -> None:
    """The robot's own name comes first, then the arguments that differ; the same arguments are the same robot."""
    source = write_fleet(folder)
    execute("init", source, "kind:=s", source, "kind:=cart10", source, "kind:=s")
    execute("add", source, "kind:=l", "name:=Big one")
    robots = config.load(folder / "urdfsync.toml").robots
    assert [(robot.name, robot.target.package, robot.arguments) for robot in robots] == [
        ("cart", "Cart", {"kind": "s"}),
        ("cart10", "Cart10", {"kind": "cart10"}),
        ("big_one", "BigOne", {"kind": "l"}),
    ], "a name that xacro does not ask for names the robot alone"
    execute("build", "-q")
    assert (folder / "modelica/Cart10/package.mo").is_file()


@pytest.mark.slow
def test_robots_of_a_fleet_have_names_and_arguments_of_their_own(folder: Path, execute: Execute) -> None:
    source = write_fleet(folder)
    execute("init", source, "kind:=s")
    with unchanged(folder):
        error = execute("add", source, "kind:=s", code=2).err
        assert f"{source} is the source of `cart` already; give xacro other arguments" in error
        error = execute("add", source, "kind:=m", "name:=Cart", code=2).err
        assert error.startswith(f"{source}: error: another robot or package has the name `Cart`; give another name")
        assert "`kind:=` is an argument of xacro, and no source is named" in execute("add", "kind:=m", code=2).err
    execute("add", source, "kind:=3", "-q")
    assert config.load(folder / "urdfsync.toml").robots[1].name == "cart_3"


@pytest.mark.slow
def test_a_missing_argument_is_told_as_a_command_that_works(folder: Path, execute: Execute) -> None:
    """The xacro of Universal Robots uses `name` before the default of `name`."""
    execute("init", write_fleet(folder))
    head = '<robot name="$(arg name)" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="name" default="ur"/>'
    arguments = '<xacro:arg name="ur_type" default="ur5x"/><link name="$(arg ur_type)"/>'
    (folder / "ur.urdf.xacro").write_text(f"{head}{arguments}</robot>")
    told = execute("add", "ur.urdf.xacro", "ur_type:=ur10e", code=2).err
    assert "the argument `name` is not set; run `urdfsync add ur.urdf.xacro ur_type:=ur10e name:=ur10e`" in told
    command = told.partition("run `urdfsync ")[2].partition("`")[0].split()
    assert "ur10e: ur.urdf.xacro becomes package Ur10e" in execute(*command).words


@pytest.mark.parametrize("fault", ["no schema", "write", "sync", "exchange"])
def test_a_failure_leaves_the_configuration_as_it_was(project: Path, execute: Execute, fault: str) -> None:
    (project / "other.json").write_text((project / "ladder.json").read_text())
    if fault == "no schema":
        (project / ".urdfsync/schema.json").mkdir(parents=True)

    def fail(operation: Operation) -> None:
        if operation.name == fault:
            raise OSError(errno.ENOSPC, "no space")

    with unchanged(project, but=".urdfsync/schema.json"), before_each(fail):
        assert "the configuration can't be written: " in execute(*ADD, "other.json", code=2).err


def test_a_link_stays_a_link(project: Path, execute: Execute) -> None:
    """The text goes to the file behind it, which keeps its permissions."""
    file, target = project / "urdfsync.toml", project / "shared.toml"
    file.rename(target)
    target.chmod(0o640)
    file.symlink_to(target.name)
    (project / "other.json").write_text((project / "ladder.json").read_text())
    execute(*ADD, "other.json", "-q")
    assert file.is_symlink()
    assert "[robots.other]" in target.read_text()
    assert target.stat().st_mode & 0o777 == 0o640


def test_without_a_configuration(folder: Path, execute: Execute) -> None:
    assert "urdfsync init" in execute("add", "arm.urdf", code=2).err


@pytest.mark.parametrize("operation", ["write", "sync", "exchange"])
def test_a_save_in_between_stays(project: Path, execute: Execute, operation: str) -> None:
    file = project / "urdfsync.toml"
    (project / "other.json").write_text((project / "ladder.json").read_text())
    saved = f"# saved\n{file.read_text()}"
    once = iter([saved])

    def save(found: Operation) -> None:
        if found.name == operation and (text := next(once, "")):
            file.write_text(text)

    with before_each(save):
        error = execute(*ADD, "other.json", code=2).err
    assert "urdfsync.toml: error: somebody saved this file meanwhile: it stays unchanged; run the command" in error
    assert file.read_text() == saved
    assert not list(project.glob(".*urdfsync-tmp*"))
