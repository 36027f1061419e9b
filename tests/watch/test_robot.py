"""The files of a watched robot: what a look at them finds, and which change is told first."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import msgspec
import pytest

from urdfsync import config
from urdfsync.files import digest
from urdfsync.watch.paths import RobotPaths
from urdfsync.watch.robot import WatchedRobot, read_state

NAMES = ["arm.urdf", "gone.stl"], ["Arm.mo"], ["*.yaml"]


@pytest.fixture
def robot(folder: Path) -> WatchedRobot:
    """A robot with a source, a template and a model, read once."""
    for path in ("arm.urdf", "more.yaml", "own/sub/a.jinja", "Arm.mo"):
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text("old")
    text = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ntemplates = "own"\n'
    (settings,) = config.parse(text, folder / "urdfsync.toml", "urdfsync.toml").robots
    inputs, outputs, patterns = (frozenset(str(folder / name) for name in names) for names in NAMES)
    found = WatchedRobot(settings, RobotPaths(inputs, outputs, patterns))
    assert found.has_changed()
    return found


def test_inputs_outputs_templates_and_what_patterns_match_are_read(robot: WatchedRobot) -> None:
    names = {os.path.relpath(path): sha256 for path, sha256 in robot.hashes.items()}
    read = dict.fromkeys(("arm.urdf", "more.yaml", "own/sub/a.jinja", "Arm.mo"), digest(b"old"))
    assert names == {**read, "gone.stl": "missing"}
    assert robot.has_files([*robot.hashes])
    assert not robot.has_files([str(Path("own").absolute())])


@pytest.mark.parametrize(("files", "first"), [
    (["arm.urdf"], "arm.urdf"), (["gone.stl"], "gone.stl"), (["new.yaml"], "new.yaml"),
    (["own/new.jinja"], "own/new.jinja"), (["Arm.mo"], "Arm.mo"), (["Arm.mo", "arm.urdf", "gone.stl"], "arm.urdf"),
    (["other.txt"], ""),
])  # fmt: skip
def test_a_look_finds_what_changed_an_input_first(robot: WatchedRobot, files: list[str], first: str) -> None:
    before = robot.hashes
    for file in files:
        Path(file).write_text("new text")
    assert robot.has_changed() is bool(first)
    assert robot.changed_file == (str(Path(first).absolute()) if first else "")
    assert robot.has_new_input(before) is (first in ("arm.urdf", "gone.stl"))
    assert not robot.has_changed()
    assert not robot.has_new_input({}), "what was not known before"


def test_a_look_at_some_files_leaves_the_others_and_one_at_a_folder_reads_all(robot: WatchedRobot) -> None:
    source, model = (str(Path(name).absolute()) for name in ("arm.urdf", "Arm.mo"))
    for path in (source, model):
        Path(path).write_text("new text")
    assert robot.has_changed([model])
    assert robot.hashes[source] == digest(b"old")
    assert not robot.has_changed([model])
    assert robot.has_changed([str(Path("own").absolute())])
    assert robot.changed_file == source


def test_of_what_is_no_file_a_word_is_known(robot: WatchedRobot, folder: Path) -> None:
    shutil.move("Arm.mo", "elsewhere.mo")
    Path("Arm.mo").symlink_to("elsewhere.mo")
    assert robot.has_changed(), "a build refuses a link in the place of a model"
    assert read_state(str(folder / "Arm.mo")) == digest(b"old")
    assert robot.hashes[str(folder / "Arm.mo")] == read_state(str(folder / "Arm.mo"), follow=False) == "other"
    assert [read_state(str(folder / name)) for name in ("own", "arm.urdf/x", "none")] == [
        "folder",
        "missing",
        "missing",
    ]


def test_to_settle_forgets_earlier_looks(robot: WatchedRobot) -> None:
    earlier = msgspec.structs.replace(robot, sample=robot.hashes, invalid_until=5.0)
    earlier.settle(3.0, is_told=True)
    assert earlier == msgspec.structs.replace(robot, due=3.0, is_told=True)
