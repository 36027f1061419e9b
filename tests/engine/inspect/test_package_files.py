"""Files of a package: what is in their places, and that the daemon reads those again that have changed."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import LADDER, rename, run

from urdfsync.common.dependencies import facts
from urdfsync.common.files import digest
from urdfsync.domain import Role
from urdfsync.engine.inspect.package_files import CLASS_FOLDER, PackageFiles, text_hash
from urdfsync.project import config

FILE = f"{LADDER}/Ladder.mo"


def files() -> PackageFiles:
    """The files of the only robot, as another build sees them."""
    loaded = config.load(Path("urdfsync.toml"))
    return PackageFiles(loaded, loaded.robots[0])


@pytest.fixture
def old(project: Path, monkeypatch: pytest.MonkeyPatch) -> bytes:
    """The content of a file that was read when it was no longer young."""
    run()
    monkeypatch.setattr(facts, "YOUNG", -(10**12))
    assert files().state(FILE)
    return Path(FILE).read_bytes()


def test_a_file_is_read_again_once_its_stat_values_differ(old: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patched:
        patched.setattr("urdfsync.common.files.read_unrecorded", lambda path: b"not read again")
        state = files().state(FILE)
    assert state is not None
    assert state.sha256 == digest(old)
    status = Path(FILE).stat()
    time.sleep(0.02)
    Path(FILE).write_bytes(old[::-1])
    os.utime(FILE, ns=(status.st_atime_ns, status.st_mtime_ns))
    state = files().state(FILE)
    assert state is not None
    assert state.sha256 == digest(old[::-1])


def test_a_file_that_is_gone_or_a_folder_is_not_what_it_was(old: bytes) -> None:
    Path(FILE).rename("elsewhere.mo")
    assert files().state(FILE) is None
    Path("elsewhere.mo").rename(FILE)
    folder = Path(LADDER)
    folder.rename("elsewhere")
    folder.symlink_to(Path("elsewhere").resolve())
    with pytest.raises(Exception, match="a symbolic link is where"):
        files().state(FILE)


def test_a_file_that_was_just_written_is_read_each_time(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run()
    assert files().state(FILE)
    monkeypatch.setattr("urdfsync.common.files.read_unrecorded", lambda path: b"read again")
    state = files().state(FILE)
    assert state is not None
    assert state.sha256 == digest(b"read again")


@pytest.mark.parametrize("command", [["build"], ["resolve", "--all", "--merge", "--prefer", "mine"]])
def test_a_model_that_is_not_utf_8_is_one_error(project: Path, execute: Execute, command: list[str]) -> None:
    run()
    edited = Path(FILE).read_bytes().replace(b"model Ladder", b"// Schl\xe4uche\nmodel Ladder")
    Path(FILE).write_bytes(edited)
    rename("R2", "R9")
    (error,) = [line for line in execute(*command, code=2).errors if "error:" in line]
    assert error.startswith(f"{FILE}:2: error: the file is not UTF-8, which Modelica demands; save it as UTF-8")
    assert Path(FILE).read_bytes() == edited
    assert not Path(LADDER, "Elements/R9.mo").exists()


def put(*paths: str) -> None:
    for path in paths:
        Path(LADDER, path).parent.mkdir(parents=True, exist_ok=True)
        Path(LADDER, path).write_bytes(b"text\r\n")


def test_a_class_that_became_a_folder_is_in_its_place(project: Path) -> None:
    put("Class/package.mo", "Empty/notes.txt", "File.mo", "Both.mo", "Both/package.mo")
    expected = {"Class.mo": CLASS_FOLDER, "Empty.mo": None, "None.mo": None, "None.txt": None, "Empty/package.mo": None}
    assert {path: files().on_disk(f"{LADDER}/{path}", Role.MODEL) for path in expected} == expected
    for path in ("File.mo", "Both.mo", "Class/package.mo"):
        assert files().on_disk(f"{LADDER}/{path}", Role.MODEL) == text_hash("text\n"), "whatever its line ends"
        assert files().on_disk(f"{LADDER}/{path}", Role.IMPORT) == text_hash("text\n"), "git may change them"
    Path(LADDER, "picture.stl").write_bytes(b"\0\r\n")
    assert files().on_disk(f"{LADDER}/picture.stl", Role.IMPORT) == digest(b"\0\r\n")[:16], "these bytes are no text"


def test_classes_are_files_and_folders(project: Path) -> None:
    put("package.mo", "A.mo", "B/package.mo", "C/notes.txt")
    found = files()
    assert found.classes(f"{LADDER}/") == {f"{LADDER}/{path}" for path in ("package.mo", "A.mo", "B/package.mo")}
    assert [name for name in ("A", "B", "C", "D", "package") if found.has_class(LADDER, name)] == [
        "A",
        "B",
        "C",
        "package",
    ]
    keys = [f"{LADDER}/A.mo", f"{LADDER}/B/package.mo"]
    top = f"{LADDER}/package.mo"
    assert found.has_classes(top, [])
    assert found.has_classes(top, keys[:1])
    assert found.has_classes(top, keys[1:])
    assert not found.has_classes(top, keys)
