"""The first configuration: it can be built at once, and says why it is as it is."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest

from urdfsync import cli, config
from urdfsync.files import TEMPORARY

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def bare(project: Path) -> Path:
    """The project without a configuration."""
    (project / "urdfsync.toml").unlink()
    return project


def init(*arguments: str) -> int:
    return cli.main(["init", "--domain", "rcnetwork", *arguments])


def test_init_then_build(bare: Path, capsys: Capture) -> None:
    assert init("ladder.json") == 0
    assert capsys.readouterr().out.splitlines() == [
        "urdfsync.toml written",
        "  ladder: ladder.json becomes package Ladder",
        "    ground = true  guessed: a node is named ground",
        "Look it over, then run `urdfsync build`.",
    ]
    assert cli.main(["build"]) == 0
    assert (bare / "modelica/Ladder/Ladder.mo").exists()


def test_the_file_explains_itself(bare: Path) -> None:
    init("ladder.json")
    text = (bare / "urdfsync.toml").read_text()
    assert 'package = "Ladder"  # full name, for example Plant.Robots.Arm' in text
    assert "ground = true  # true or false; guessed: a node is named ground" in text
    assert '# prefix = "node"' in text


def test_what_is_commented_out_is_right(bare: Path) -> None:
    (bare / "templates").mkdir()
    init("ladder.json")
    file = bare / "urdfsync.toml"
    lines = [line.removeprefix("# ") if " = " in line else line for line in file.read_text().splitlines()]
    file.write_text("\n".join(lines))
    assert cli.main(["build", "--dry-run"]) == 0


def test_choices_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text('<robot name="arm"><link name="world"/></robot>')
    assert cli.main(["init"]) == 0
    text = (tmp_path / "urdfsync.toml").read_text()
    assert 'base = "fixed"  # "fixed" or "floating"; guessed: ' in text
    assert '# visualizer = "standard"  # "standard" or "visualization2"' in text
    assert '# approach = ["package"]  # a list of "package" or "record"' in text
    assert '# frames = "leaves"  # "leaves" or "all" or a list of strings' in text
    assert "driven" not in text, "it has no value that leaves the choice to urdfsync"
    config.load(tmp_path / "urdfsync.toml")


def test_an_existing_file_is_never_overwritten(project: Path, capsys: Capture) -> None:
    before = (project / "urdfsync.toml").read_bytes()
    assert init("ladder.json") == 2
    assert capsys.readouterr().err.startswith("urdfsync.toml: error: the file exists already; add a table")
    assert (project / "urdfsync.toml").read_bytes() == before


def test_a_broken_source_is_told_and_nothing_written(bare: Path, capsys: Capture) -> None:
    (bare / "ladder.json").write_text("{")
    assert init("ladder.json") == 2
    assert capsys.readouterr().err.startswith("ladder.json:1: error: ")
    assert init("missing.json") == 2
    assert "missing.json: error: the source can't be read" in capsys.readouterr().err
    assert not (bare / "urdfsync.toml").exists()


def test_without_sources_all_below_are_taken(bare: Path, capsys: Capture) -> None:
    for name in ("a/Ladder.rcnetwork", "b/ladder.RCNETWORK", "b/2nd-stage (old).v2.rcnetwork", ".hidden/x.rcnetwork"):
        file = bare / name
        file.parent.mkdir(exist_ok=True)
        file.write_bytes((bare / "ladder.json").read_bytes())
    assert init() == 0
    loaded = config.load(bare / "urdfsync.toml")
    assert [(robot.name, robot.source_text, robot.target.package) for robot in loaded.robots] == [
        ("ladder", "a/Ladder.rcnetwork", "Ladder"),
        ("2nd_stage_old", "b/2nd-stage (old).v2.rcnetwork", "Robot2ndStageOld"),
        ("ladder2", "b/ladder.RCNETWORK", "Ladder2"),
    ]


def test_a_broken_source_is_passed_over_if_nobody_named_it(bare: Path, capsys: Capture) -> None:
    (bare / "bad.rcnetwork").write_text("{")
    (bare / ".hidden.rcnetwork").write_text("{")
    assert init() == 2, "there is nothing else"
    assert capsys.readouterr().err.startswith("bad.rcnetwork:1: error: ")
    assert not (bare / "urdfsync.toml").exists()
    (bare / "good.rcnetwork").write_bytes((bare / "ladder.json").read_bytes())
    assert init() == 0
    streams = capsys.readouterr()
    (line,) = streams.err.splitlines()
    assert line.startswith("bad.rcnetwork:1: warning: ")
    assert line.endswith("; passed over; put it right and add it, or run `urdfsync init bad.rcnetwork` [json]")
    assert [robot.name for robot in config.load(bare / "urdfsync.toml").robots] == ["good"]


def test_a_source_that_is_named_twice_is_one_robot(bare: Path) -> None:
    (bare / "other.json").write_bytes((bare / "ladder.json").read_bytes())
    assert init("ladder.json", "./other.json", str(bare / "ladder.json"), "../project/ladder.json") == 0
    assert [robot.name for robot in config.load(bare / "urdfsync.toml").robots] == ["ladder", "other"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such names")
@pytest.mark.parametrize("name", ["a\udcff.json", "a\n[x].json", "a\x1b.json"])
def test_a_source_whose_name_no_configuration_can_hold(bare: Path, capsys: Capture, name: str) -> None:
    (bare / name).write_bytes((bare / "ladder.json").read_bytes())
    assert init(name) == 2
    streams = capsys.readouterr()
    assert "the name of the source can't be written into a configuration; rename it [source-name]" in streams.err
    assert streams.err.rstrip("\n").isprintable()
    assert not (bare / "urdfsync.toml").exists()


def test_long_and_taken_names_give_a_configuration_that_is_right(bare: Path) -> None:
    names = ["x" * 200, "modelica", "aux", "real", "links", "Package", "urdfsync", "visualization2", "3d"]
    for name in names:
        (bare / f"{name}.json").write_bytes((bare / "ladder.json").read_bytes())
    assert init(*(f"{name}.json" for name in names)) == 0
    assert len(config.load(bare / "urdfsync.toml").robots) == len(names)


@pytest.mark.parametrize("failing", ["open", "replace"])
def test_a_disk_that_is_full_leaves_no_configuration_behind(
    bare: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, failing: str
) -> None:
    real = getattr(Path, failing)

    def refuse(path: Path, *arguments: Any, **options: Any) -> Any:
        if path.name.endswith(TEMPORARY):
            raise OSError(28, "No space left on device", str(path))
        return real(path, *arguments, **options)

    monkeypatch.setattr(Path, failing, refuse)
    before = sorted(bare.iterdir())
    assert init("ladder.json") == 2
    message = "urdfsync.toml: error: the configuration can't be written: No space left on device; check the folder's"
    assert capsys.readouterr().err.startswith(message)
    assert sorted(bare.iterdir()) == before


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_no_link_in_a_repository_leads_init_outside(bare: Path, tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("precious")
    (bare / ".urdfsync.toml.urdfsync-tmp").symlink_to(victim)
    assert init("ladder.json") == 0
    assert victim.read_text() == "precious"


def test_without_sources_and_none_below(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.main(["init"]) == 2
    assert "no *.urdf below" in capsys.readouterr().err


def test_names_from_the_source_stay_inside_their_comment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    link = '<link name="base_footprint&#10;output = 1 &quot;"/>'
    (tmp_path / "arm.urdf").write_text(f'<robot name="arm">{link}</robot>')
    assert cli.main(["init"]) == 0
    table = tomllib.loads((tmp_path / "urdfsync.toml").read_text())["robots"]["arm"]
    assert set(table) == {"source", "package", "base"}


def test_sources_count_from_the_folder_of_the_configuration_which_must_be_there(bare: Path, capsys: Capture) -> None:
    assert init("ladder.json", "--config", "deep/own.toml") == 2
    assert "the configuration can't be written: No such file or directory" in capsys.readouterr().err
    (bare / "deep").mkdir()
    assert init("ladder.json", "--config", "deep/own.toml") == 0
    assert config.load(bare / "deep/own.toml").robots[0].source_text == "../ladder.json"
