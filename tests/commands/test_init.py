"""The first configuration: it can be built at once, and says why it is as it is."""

from __future__ import annotations

import os
import sys
import tomllib
from pathlib import Path

import pytest
from support.commands import Execute, Terminal
from support.git import NEEDS_GIT, Repository
from support.urdfs import joint, links, robot

from urdfsync.project import config

INIT = ("init", "--domain", "rcnetwork")


@pytest.fixture
def bare(project: Path) -> Path:
    """The project without a configuration."""
    (project / "urdfsync.toml").unlink()
    return project


def test_init_then_build(bare: Path, execute: Execute) -> None:
    """The file has the keys that matter, and names the page with all others."""
    assert execute(*INIT, "ladder.json").lines == [
        "urdfsync.toml written",
        "  ladder: ladder.json becomes package Ladder",
        "    ground = true  guessed: a node is named ground",
        "Look it over, then run `urdfsync build`.",
    ]
    file = bare / "urdfsync.toml"
    assert file.read_text().splitlines() == [
        "#:schema .urdfsync/schema.json",
        "# Robots that urdfsync keeps in step with their Modelica packages.",
        "# Paths are relative to this file's folder. All other keys: docs/configuration.md of urdfsync.",
        "",
        "[robots.ladder]",
        'source = "ladder.json"',
        'package = "Ladder"  # full name, for example Plant.Robots.Arm; its last part names the class',
        'domain = "rcnetwork"',
        "ground = true  # true or false; guessed: a node is named ground",
    ]
    execute("build")
    assert (bare / "modelica/Ladder/Ladder.mo").exists()
    file.unlink()
    execute(*INIT, "ladder.json", "--merge")
    assert '\n[defaults]\non_conflict = "merge"\n\n[robots.ladder]\n' in file.read_text()


def test_choices_are_named(execute: Execute, folder: Path) -> None:
    assert "no *.urdf below" in execute("init", code=2).err
    (folder / "arm.urdf").write_text('<robot name="arm"><link name="world"/></robot>')
    execute("init")
    text = (folder / "urdfsync.toml").read_text()
    assert 'base = "fixed"  # "fixed" or "floating"; guessed: ' in text
    config.load(folder / "urdfsync.toml")


def test_a_warning_is_told_after_the_summary_and_a_note_by_the_build_alone(execute: Execute, folder: Path) -> None:
    """A source beside the project has the same path in both."""
    (folder / "cad").mkdir()
    (folder / "cad/arm.urdf").write_text('<robot name="arm"><link name="world"/><gazebo><mu2>1</mu2></gazebo></robot>')
    (folder / "demo").mkdir()
    os.chdir(folder / "demo")
    assert execute("init", "../cad/arm.urdf").err == ""
    assert execute("build").err.startswith(f"{Path('../cad/arm.urdf')}:1: note: not modelled: ")
    os.chdir("modelica")
    assert execute("build").err == "arm: still 1 finding (not-modelled); --verbose shows it\n", (
        "by another path, it is the same"
    )


def test_missing_meshes_are_told_with_what_to_write(execute: Execute, folder: Path) -> None:
    """In `add`, too; found ones are not told."""
    meshes = "package://arm_description/a.stl", "package://arm_description/b.stl", "c.stl", "d.stl"
    shapes = [f'<visual><geometry><mesh filename="{name}"/></geometry></visual>' for name in meshes]
    (folder / "arm.urdf").write_text(f'<robot name="arm"><link name="world">\n{"".join(shapes)}</link></robot>')
    (folder / "d.stl").touch()
    told = [
        "arm.urdf:2: warning: mesh `c.stl` not found; put it there, or name the folder where this path begins in the "
        "robot's `package_paths` [mesh-not-found]",
        "arm.urdf:2: warning: 2 meshes (such as `package://arm_description/a.stl`) not found; put it into the package "
        "`arm_description`, or name the folder around that in the robot's `package_paths` [mesh-not-found]",
    ]
    assert execute("init", "arm.urdf").err.splitlines() == told
    (folder / "arm.urdf").rename(folder / "leg.urdf")
    assert execute("add", "leg.urdf").err.splitlines() == [line.replace("arm.urdf", "leg.urdf") for line in told]


def test_what_a_model_leaves_out_is_allowed(execute: Execute, folder: Path) -> None:
    loop = '<loop_joint name="bar" type="prismatic"><link1 link="world"/><link2 link="world"/></loop_joint>'
    (folder / "arm.urdf").write_text(f'<robot name="arm"><link name="world"/>\n{loop}</robot>')
    said = execute("init", "arm.urdf")
    assert "arm.urdf:2: warning: loop bar has type='prismatic', which is no kind of loop" in said.words
    assert '    allow = ["loop-joint"]  guessed: the model leaves this part out, see the warnings' in said.lines
    assert "[loop-joint]" in execute("build").err
    (folder / "leg.urdf").write_text('<robot name="leg"><link name="world"/><inertial/></robot>')
    execute("add", "leg.urdf")
    execute("build")


def test_loops_at_a_dead_point_need_a_start(execute: Execute, folder: Path) -> None:
    """A parallelogram in line, in the spelling of Isaac Sim's page."""
    bars = [joint(name, "continuous", *ends, axis="0 0 1", xyz=xyz, rpy="0 0 0") for name, *ends, xyz in (
        ("crank", "base", "a", "0 0 0"), ("j 2", "a", "b", "1 0 0"), ("rocker", "base", "c", "2 0 0")
    )]  # fmt: skip
    ends = '<link1 link="b" xyz="2 0 0" rpy="0 0 0"/><link1 link="c" xyz="1 0 0" rpy="0 0 0"/>'
    pin = f'<loop_joint name="pin" type="spherical">{ends}</loop_joint>'
    (folder / "bars.urdf").write_text(robot(*links(base=1.0, a=1.0, b=1.0, c=1.0), *bars, pin))
    said = execute("init", "bars.urdf")
    assert "warning: loop 'pin' is singular at the start" in said.words
    assert "let the loop's joints start elsewhere, by `start`" in execute("build", code=2).words
    with (folder / "urdfsync.toml").open("a") as file:
        file.write('start = { crank = 0.5, "j 2" = -0.5 }\n')
    execute("build")


def test_an_existing_file_is_never_overwritten(project: Path, execute: Execute) -> None:
    before = (project / "urdfsync.toml").read_bytes()
    assert execute(*INIT, "ladder.json", code=2).err.startswith(
        "urdfsync.toml: error: the file exists already; `urdfsync add SOURCE`"
    )
    assert (project / "urdfsync.toml").read_bytes() == before


def test_a_broken_source_is_told_and_nothing_written(bare: Path, execute: Execute) -> None:
    (bare / "ladder.json").write_text("{")
    assert execute(*INIT, "ladder.json", code=2).err.startswith("ladder.json:1: error: ")
    assert "missing.json: error: the source can't be read" in execute(*INIT, "missing.json", code=2).err
    assert not (bare / "urdfsync.toml").exists()


def test_without_sources_all_below_are_taken(bare: Path, execute: Execute) -> None:
    for name in ("a/Ladder.rcnetwork", "b/ladder.RCNETWORK", "b/2nd-stage (old).v2.rcnetwork", ".hidden/x.rcnetwork"):
        file = bare / name
        file.parent.mkdir(exist_ok=True)
        file.write_bytes((bare / "ladder.json").read_bytes())
    execute(*INIT)
    loaded = config.load(bare / "urdfsync.toml")
    assert [(robot.name, robot.source_text, robot.target.package) for robot in loaded.robots] == [
        ("ladder", "a/Ladder.rcnetwork", "Ladder"),
        ("2nd_stage_old", "b/2nd-stage (old).v2.rcnetwork", "Robot2ndStageOld"),
        ("ladder2", "b/ladder.RCNETWORK", "Ladder2"),
    ]


def test_after_a_failure_it_can_be_run_again(bare: Path, execute: Execute) -> None:
    (bare / ".urdfsync/schema.json").mkdir(parents=True)
    assert "can't be written" in execute("init", "ladder.json", "--domain", "rcnetwork", code=2).err
    (bare / ".urdfsync/schema.json").rmdir()
    execute("init", "ladder.json", "--domain", "rcnetwork")


def test_a_broken_source_is_passed_over_if_nobody_named_it(execute: Execute, bare: Path) -> None:
    (bare / "bad.rcnetwork").write_text("{")
    (bare / ".hidden.rcnetwork").write_text("{")
    assert execute(*INIT, code=2).err.startswith("bad.rcnetwork:1: error: "), "there is nothing else"
    assert not (bare / "urdfsync.toml").exists()
    (bare / "good.rcnetwork").write_bytes((bare / "ladder.json").read_bytes())
    streams = execute(*INIT)
    (line,) = streams.err.splitlines()
    assert line.startswith("bad.rcnetwork:1: warning: ")
    assert line.endswith("; left out; correct the source and add it, or run `urdfsync init bad.rcnetwork` [json]")
    assert [robot.name for robot in config.load(bare / "urdfsync.toml").robots] == ["good"]


def test_a_source_that_is_named_twice_is_one_robot(execute: Execute, bare: Path) -> None:
    (bare / "other.json").write_bytes((bare / "ladder.json").read_bytes())
    execute(*INIT, "ladder.json", "./other.json", str(bare / "ladder.json"), "../project/ladder.json")
    assert [robot.name for robot in config.load(bare / "urdfsync.toml").robots] == ["ladder", "other"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such names")
@pytest.mark.parametrize("name", ["a\udcff.json", "a\n[x].json", "a\x1b.json"])
def test_a_source_whose_name_no_configuration_can_hold(bare: Path, execute: Execute, name: str) -> None:
    (bare / name).write_bytes((bare / "ladder.json").read_bytes())
    streams = execute(*INIT, name, code=2)
    assert "the name of the source can't be written into a configuration; rename it [source-name]" in streams.err
    assert streams.err.rstrip("\n").isprintable()
    assert not (bare / "urdfsync.toml").exists()


def test_long_and_taken_names_give_a_configuration_that_is_right(execute: Execute, bare: Path) -> None:
    names = [
        "x" * (200 if os.name == "posix" else 100),
        "modelica",
        "aux" if os.name == "posix" else "auxiliary",
        "real",
        "links",
        "Package",
        "urdfsync",
        "3d",
    ]
    for name in names:
        (bare / f"{name}.json").write_bytes((bare / "ladder.json").read_bytes())
    execute(*INIT, *(f"{name}.json" for name in names))
    assert len(config.load(bare / "urdfsync.toml").robots) == len(names)


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_no_link_in_a_repository_leads_init_outside(execute: Execute, bare: Path, tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("precious")
    (bare / ".urdfsync.toml.urdfsync-tmp").symlink_to(victim)
    execute(*INIT, "ladder.json")
    assert victim.read_text() == "precious"


def test_names_from_the_source_stay_inside_their_comment(execute: Execute, folder: Path) -> None:
    link = '<link name="base_footprint&#10;output = 1 &quot;"/>'
    (folder / "arm.urdf").write_text(f'<robot name="arm">{link}</robot>')
    execute("init")
    table = tomllib.loads((folder / "urdfsync.toml").read_text())["robots"]["arm"]
    assert set(table) == {"source", "package", "base"}


def test_sources_count_from_the_folder_of_the_configuration_which_must_be_there(bare: Path, execute: Execute) -> None:
    assert (
        "deep/own.toml: error: the configuration can't be written: "
        in execute(*INIT, "ladder.json", "--config", "deep/own.toml", code=2).words
    )
    (bare / "deep").mkdir()
    execute(*INIT, "ladder.json", "--config", "deep/own.toml")
    assert config.load(bare / "deep/own.toml").robots[0].source_text == "../ladder.json"


# In a clone


@pytest.fixture
def clone(bare: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    return Repository(bare, monkeypatch)


def has_driver(clone: Repository) -> bool:
    """Whether git merges with urdfsync; both parts of that, or none."""
    attributes = clone.folder / ".gitattributes"
    is_named = attributes.exists() and attributes.read_text() == "*.mo merge=urdfsync\n"
    assert is_named == ("merge.urdfsync.driver=" in clone.git("config", "--list", "--local"))
    return is_named


@NEEDS_GIT
def test_the_merge_driver_is_set_up_by_name(clone: Repository, execute: Execute) -> None:
    assert execute(*INIT, "ladder.json", "--merge-driver").out.startswith(
        f"git merges with urdfsync in {clone.folder}\n"
    )
    assert has_driver(clone)
    (clone.folder / "urdfsync.toml").unlink()
    assert "no-merge-driver" not in execute(*INIT, "ladder.json").err, "it is there already"


@NEEDS_GIT
@pytest.mark.parametrize(("answer", "agrees"), [("y", True), ("", False)])
def test_the_merge_driver_is_offered(
    clone: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch, answer: str, agrees: bool
) -> None:
    monkeypatch.setattr(sys, "stdin", Terminal(answer))
    printed = execute(*INIT, "ladder.json")
    assert "merge these models by their elements, in this clone? [y/N]" in printed.out
    assert "no-merge-driver" not in printed.err
    assert has_driver(clone) is agrees
    assert (clone.folder / "urdfsync.toml").exists()


@NEEDS_GIT
def test_without_a_terminal_the_merge_driver_is_a_hint(clone: Repository, execute: Execute) -> None:
    assert "`urdfsync merge-driver --install` [no-merge-driver]" in execute(*INIT, "ladder.json").err
    assert not has_driver(clone)


@NEEDS_GIT
def test_outside_of_a_clone_no_driver_is_spoken_of(
    bare: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(bare.parent))
    monkeypatch.setattr(sys, "stdin", Terminal("y"))
    printed = execute(*INIT, "ladder.json")
    assert (printed.err, "[y/N]" in printed.out) == ("", False)
    (bare / "urdfsync.toml").unlink()
    assert "run it in a clone [git]" in execute(*INIT, "ladder.json", "--merge-driver", code=2).err
    assert not (bare / "urdfsync.toml").exists()


@pytest.mark.parametrize(("source", "called", "package"), [
    ("iCub/model.urdf", "icub", "ICub"), ("robots/Häuser/robot.urdf", "hauser", "Hauser"),
    ("cad/g1_29dof.urdf", "g1_29dof", "G1_29dof"), ("tool/urdf/model.urdf", "tool", "Tool"),
])  # fmt: skip
def test_a_robot_is_named_by_its_source_unless_many_have_that_name(
    bare: Path, execute: Execute, source: str, called: str, package: str
) -> None:
    Path(source).parent.mkdir(parents=True)
    Path(source).write_text(robot(*links(base=1.0), name="iCub" if "iCub" in source else "robot"))
    assert f"{called}: {source} becomes package {package}" in execute("init", source).words
