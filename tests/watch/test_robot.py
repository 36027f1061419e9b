"""What a look at a watched robot finds of all that its last build read, and which change is told first."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

import msgspec
import pytest

from urdfsync.common.dependencies import facts
from urdfsync.common.dependencies.reads import Reads, file_type, list_folder, read_file, read_variable, scan_folder
from urdfsync.common.files import Tree, digest
from urdfsync.project import config
from urdfsync.watch.robot import WatchedRobot


@pytest.fixture(params=[True, False], ids=["young", "old"])
def robot(folder: Path, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> WatchedRobot:
    """A robot with a source, templates and a model; its files are young or old when they are read."""
    monkeypatch.setattr(facts, "YOUNG", 10**18 if request.param else 0)
    for path in ("arm.urdf", "own/a.jinja", "models/Own.mo", "Arm.mo"):
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text("old")
    text = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ntemplates = "own"\n'
    found = WatchedRobot(config.parse(text, folder / "urdfsync.toml", "urdfsync.toml").robots[0])
    assert found.take(read(folder).entries, {})
    assert found.look()
    assert not found.look()
    assert not found.has_changed
    return found


def read(folder: Path) -> Reads:
    with Reads() as reads:
        for path in ("arm.urdf", "own/a.jinja"):
            assert read_file(folder / path)
        assert file_type(folder / "gone.stl") == 0
        assert list_folder(folder / "own")
        assert scan_folder(folder / "models", facts.MODELICA)
        assert Tree(folder).read(folder / "Arm.mo")
        assert Tree(folder).read(folder / "New.mo") is None
        assert read_variable("PATH") is not None
    return reads


@pytest.mark.parametrize(("files", "first"), [
    (["arm.urdf"], "arm.urdf"), (["gone.stl"], "gone.stl"), (["own/a.jinja"], "own/a.jinja"), (["Arm.mo"], "Arm.mo"),
    (["New.mo"], "New.mo"), (["Arm.mo", "arm.urdf", "gone.stl"], "arm.urdf"), (["own/new.jinja"], None),
    (["models/New.mo"], None), (["other.txt"], ""), (["models/other.txt"], ""),
])  # fmt: skip
def test_a_look_finds_what_changed_an_input_first_and_names_in_folders_in_silence(
    robot: WatchedRobot, files: list[str], first: str | None
) -> None:
    for file in files:
        Path(file).write_text("new")
    robot.look()
    assert robot.has_changed is (first != "")
    assert robot.changed_file == (str(Path(first).absolute()) if first else "")


def test_a_deleted_file_has_changed(robot: WatchedRobot) -> None:
    Path("arm.urdf").unlink()
    robot.look()
    assert robot.changed_file == str(Path("arm.urdf").absolute())


def test_what_changed_since_it_was_read_has_changed(robot: WatchedRobot, folder: Path) -> None:
    """Though no look has been between the two."""
    reads = read(folder)
    time.sleep(0.02)
    Path("arm.urdf").write_text("now")
    assert not robot.take(reads.entries, {}), "the entries are the same"
    robot.look()
    assert robot.changed_file == str(Path("arm.urdf").absolute())


def test_what_a_build_wrote_has_not(robot: WatchedRobot, folder: Path) -> None:
    reads = read(folder)
    for name in ("New.mo", "Arm.mo"):
        Path(name).write_text("written")
    reads.renew({str(folder / name): digest(b"written") for name in ("New.mo", "Arm.mo")})
    robot.take(reads.entries, {})
    robot.look()
    assert not robot.has_changed
    Path("New.mo").write_text("WRITTEN")
    robot.look()
    assert robot.changed_file == str(folder / "New.mo")


def test_after_a_bug_the_robot_is_as_it_is(robot: WatchedRobot) -> None:
    Path("arm.urdf").write_text("new")
    assert not robot.take({}, {})
    robot.look()
    assert not robot.has_changed


def test_a_young_file_changes_by_its_content(
    robot: WatchedRobot, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(facts, "YOUNG", 10**19)
    monkeypatch.setattr(facts, "stat_of", lambda status, *_: (status.st_mode, 0, 0, status.st_size, 1, 1))
    robot.take(read(folder).entries, {})
    robot.look()
    assert not robot.has_changed
    Path("arm.urdf").write_text("new")
    robot.look()
    assert robot.changed_file == str(Path("arm.urdf").absolute())


def test_a_link_in_the_place_of_a_file_is_a_change(robot: WatchedRobot) -> None:
    shutil.move("arm.urdf", "arm.urdf.moved")
    Path("arm.urdf").symlink_to("arm.urdf.moved")
    robot.look()
    assert robot.changed_file == str(Path("arm.urdf").absolute())


def test_to_settle_compares_with_the_last_look(robot: WatchedRobot) -> None:
    earlier = msgspec.structs.replace(robot, settling={}, invalid_until=5.0)
    earlier.settle(3.0, is_told=True)
    assert earlier == msgspec.structs.replace(robot, due=3.0, is_told=True, settling=robot.seen)


def test_facts_that_the_last_look_found_need_no_further_look(robot: WatchedRobot, folder: Path) -> None:
    """A young file is looked at, since its stat values may hide a change."""
    for entry in robot.places:
        is_young = facts.YOUNG > 0 and entry[0] == facts.PATH and Path(entry[1]).exists()
        assert robot.has_seen({entry: facts.look(*entry)}) != is_young
    assert robot.has_seen({("path", str(folder / "other.txt")): (0,)})
    gone = ("path", str(folder / "gone.stl"))
    Path("gone.stl").write_text("new")
    assert not robot.has_seen({gone: facts.look(*gone)})
    names = ("names", str(folder / "own"))
    Path("own/new.jinja").write_text("new")
    assert not robot.has_seen({names: facts.look(*names)})
