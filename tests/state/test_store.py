"""The state folder: what is loaded, what is to be written, and what that rests on."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from urdfsync.diagnostics import OutputError, StateError
from urdfsync.files import digest
from urdfsync.state import manifest, modelfile
from urdfsync.state.manifest import Generator, Manifest, Source
from urdfsync.state.store import Store
from urdfsync.state.transaction import Change

MODEL = modelfile.dumps(modelfile.of({"name": "arm"}, {}))
MANIFEST = Manifest(
    package="Arm",
    class_="Arm",
    folder="Arm",
    source=Source("arm.urdf", "5a", manifest.text_hash(MODEL)),
    generator=Generator("urdf", 3, "9c"),
)
TEXT = manifest.dumps(MANIFEST)


def write(*changes: Change) -> None:
    """Carry changes out, which have to rest on what is there."""
    for change in changes:
        there = change.path.read_bytes() if change.path.exists() else None
        assert change.old == (None if there is None else digest(there))
        if change.content is None:
            change.path.unlink()
        else:
            change.path.parent.mkdir(parents=True, exist_ok=True)
            change.path.write_bytes(change.content)


def files(root: Path) -> set[str]:
    return {path.relative_to(root / ".urdfsync").as_posix() for path in root.rglob("*") if path.is_file()}


@pytest.fixture
def built(tmp_path: Path) -> Path:
    """A folder with the state of robot `arm`."""
    store = Store(tmp_path)
    store.load("arm")
    write(*store.changes("arm", TEXT, MODEL, None))
    return tmp_path


def test_what_is_written_is_loaded(built: Path) -> None:
    state = Store(built).load("arm")
    assert state is not None
    assert state.manifest == MANIFEST
    assert state.model is not None
    assert state.model.snapshot == {"name": "arm"}
    assert state.intact
    assert Store(built).names() == ["arm"]
    assert Store(built).texts("arm") == (TEXT, MODEL)


def test_what_is_there_is_not_written_again(built: Path) -> None:
    store = Store(built)
    store.load("arm")
    assert list(store.changes("arm", TEXT, MODEL, None)) == []
    assert [change.path.name for change in store.changes("arm", TEXT + "# more\n", None, None)] == ["arm.toml"]


def test_a_checkout_with_other_line_endings_is_not_written_again(built: Path) -> None:
    for path in Store(built).paths("arm"):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    store = Store(built)
    state = store.load("arm")
    assert state is not None
    assert state.intact
    assert list(store.changes("arm", TEXT, MODEL, None)) == []


def test_a_state_without_its_model_is_not_intact(built: Path) -> None:
    Store(built).paths("arm")[1].unlink()
    state = Store(built).load("arm")
    assert state is not None
    assert (state.manifest, state.model, state.intact) == (MANIFEST, None, False)


def test_a_model_of_another_build_is_not_intact(built: Path) -> None:
    Store(built).paths("arm")[1].write_text(modelfile.dumps(modelfile.of({"name": "leg"}, {})))
    state = Store(built).load("arm")
    assert state is not None
    assert not state.intact


@pytest.mark.parametrize("number", [0, 1], ids=["manifest", "model"])
def test_a_state_that_is_no_text_is_refused_with_its_name(built: Path, number: int) -> None:
    path = Store(built).paths("arm")[number]
    path.write_bytes(b"\xff")
    with pytest.raises(StateError, match=rf"{path.name}.*not UTF-8"):
        Store(built).load("arm")
    assert Store(built).texts("arm")[number] == "\N{REPLACEMENT CHARACTER}"


def test_the_witness_is_what_was_loaded(built: Path) -> None:
    store = Store(built)
    store.load("arm")
    witness = store.witness()
    assert Store(built).is_unchanged(witness)
    path, beside = store.paths("arm")
    assert witness == {path: digest(TEXT.encode()), beside: digest(MODEL.encode())}
    path.write_text(TEXT + "\n")
    assert not Store(built).is_unchanged(witness)
    path.unlink()
    assert not Store(built).is_unchanged(witness)


def test_changes_rest_on_what_was_loaded_not_on_what_came_later(built: Path) -> None:
    store = Store(built)
    store.load("arm")
    store.paths("arm")[0].write_text("saved in between")
    (change,) = store.changes("arm", TEXT + "\n", None, None)
    assert change.old == digest(TEXT.encode())


def test_texts_of_conflicts_come_stay_and_go(tmp_path: Path) -> None:
    write(*Store(tmp_path).conflicts("arm", {"Links/A.base.mo": b"1", "B.base.mo": b"2"}, None))
    assert files(tmp_path) == {"conflicts/arm/Links/A.base.mo", "conflicts/arm/B.base.mo"}
    changes = Store(tmp_path).conflicts("arm", {"B.base.mo": b"2", "B.merge.txt": b"3"}, None)
    assert {(change.path.name, change.content) for change in changes} == {("A.base.mo", None), ("B.merge.txt", b"3")}
    write(*changes)
    assert Store(tmp_path).conflicts("arm", {"B.base.mo": b"2", "B.merge.txt": b"3"}, None) == []
    write(*Store(tmp_path).conflicts("arm", {}, None))
    assert files(tmp_path) == set()


def test_conflicts_of_a_robot_with_another_name_go(tmp_path: Path) -> None:
    write(*Store(tmp_path).conflicts("arm", {"A.base.mo": b"1"}, None))
    write(*Store(tmp_path).conflicts("leg", {"A.base.mo": b"1"}, "arm"))
    assert files(tmp_path) == {"conflicts/leg/A.base.mo"}


def test_conflicts_at_the_end_of_a_link_are_not_listed(tmp_path: Path) -> None:
    folder, elsewhere = tmp_path / ".urdfsync/conflicts", tmp_path / "elsewhere"
    folder.mkdir(parents=True)
    (elsewhere / "locked").mkdir(parents=True)
    (folder / "arm").symlink_to(elsewhere)
    with pytest.raises(OutputError, match="symbolic link"):
        Store(tmp_path).conflicts("arm", {}, None)


def test_version_control_is_told_once_and_by_nobody_else(tmp_path: Path) -> None:
    (change,) = Store(tmp_path).ignoring()
    assert change.path == tmp_path / ".urdfsync" / ".gitignore"
    assert b"!/robots/" in (change.content or b"")
    write(change)
    change.path.write_text("# the user's\n")
    assert Store(tmp_path).ignoring() == []


def test_the_manifest_is_written_last_and_that_of_a_former_name_goes_after_it(built: Path) -> None:
    store = Store(built)
    assert store.load("leg") is None
    store.load("arm")
    changes = list(store.changes("leg", TEXT, MODEL, "arm"))
    assert [change.path.name for change in changes] == ["leg.json", "leg.toml", "arm.toml", "arm.json"]
    write(*changes)
    assert files(built) == {"robots/leg.toml", "robots/leg.json"}


FOLDERS = ".urdfsync/folders.json"


def test_noted_folders_are_those_of_each_robot(tmp_path: Path) -> None:
    store = Store(tmp_path)
    assert store.written_folders("arm") == frozenset()
    store.note_folders("arm", ["m/Arm"])
    store.note_folders("leg", ["m/Leg", "m/Old"])
    written = (tmp_path / FOLDERS).stat().st_ino
    store.note_folders("leg", ["m/Old", "m/Leg"])
    assert (tmp_path / FOLDERS).stat().st_ino == written, "it is as it was"
    assert Store(tmp_path).written_folders("leg") == {"m/Leg", "m/Old"}
    store.note_folders("hand", ["m/Arm"], former="arm")
    assert [Store(tmp_path).written_folders(robot) for robot in ("arm", "hand")] == [frozenset(), {"m/Arm"}]


@pytest.mark.parametrize("change", ["copied", "touched", "cut short", "link", "folder"])
def test_folders_that_were_not_noted_here_do_not_count(tmp_path: Path, change: str) -> None:
    Store(tmp_path).note_folders("arm", ["m/Arm"])
    file = tmp_path / FOLDERS
    copy = file.with_name("copy")
    shutil.copy2(file, copy)
    if change == "touched":
        os.utime(file)
    elif change == "cut short":
        file.write_bytes(b"{")
    else:
        file.unlink()
        if change == "copied":
            copy.rename(file)
        elif change == "link":
            file.symlink_to(copy)
        else:
            file.mkdir()
    assert Store(tmp_path).written_folders("arm") == frozenset()


def test_folders_are_not_noted_through_a_link(tmp_path: Path) -> None:
    outside, root = tmp_path / "outside", tmp_path / "root"
    (root / ".urdfsync").mkdir(parents=True)
    outside.mkdir()
    for name in ("folders.json", ".folders.json.urdfsync-tmp"):
        (root / ".urdfsync" / name).symlink_to(outside / "victim")
    Store(root).note_folders("arm", ["m/Arm"])
    assert Store(root).written_folders("arm") == {"m/Arm"}
    shutil.rmtree(root / ".urdfsync")
    (root / ".urdfsync").symlink_to(outside)
    with pytest.raises(OutputError, match="symbolic link"):
        Store(root).note_folders("arm", ["m/Arm"])
    assert list(outside.iterdir()) == []
