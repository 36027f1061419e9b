"""The operations that files change by, on systems that can do much and on those that can't."""

from __future__ import annotations

import _thread
import errno
import io
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfsync.state import operations


def refusing(number: int) -> Callable[..., None]:
    def refuse(*paths: object, **options: object) -> None:
        raise OSError(number, os.strerror(number))

    return refuse


@pytest.fixture(params=["renames", "links", "no links", "other file system"])
def system(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    if request.param != "renames":
        monkeypatch.setattr(operations, "_renaming", lambda: lambda *_: errno.ENOSYS)
    if request.param == "no links":
        monkeypatch.setattr(os, "link", refusing(errno.EPERM))
    if request.param == "other file system":
        monkeypatch.setattr(os, "link", refusing(errno.EXDEV))
        real = Path.replace

        def replace(path: Path, target: Path) -> Path:
            if path.parent != target.parent:
                raise OSError(errno.EXDEV, os.strerror(errno.EXDEV))
            return real(path, target)

        monkeypatch.setattr(Path, "replace", replace)
    return str(request.param)


@pytest.fixture
def old(tmp_path: Path) -> Path:
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    path = tmp_path / "a" / "old"
    path.write_bytes(b"old")
    path.chmod(0o640)
    return path


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_a_written_file_is_new(tmp_path: Path, old: Path) -> None:
    link = tmp_path / "link"
    link.symlink_to(old)
    operations.write(link, b"new", like=old)
    assert (link.read_bytes(), old.read_bytes()) == (b"new", b"old")
    assert not link.is_symlink()
    assert link.stat().st_mode == old.stat().st_mode


def test_a_file_that_the_system_takes_in_pieces_is_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Slow(io.FileIO):
        def write(self, content: Any) -> int:
            return super().write(bytes(content)[:3])

    monkeypatch.setattr(operations, "open", lambda path, mode, buffering: Slow(path, mode), raising=False)
    operations.write(tmp_path / "new", b"0123456789")
    assert (tmp_path / "new").read_bytes() == b"0123456789"


def test_what_is_kept_outlives_its_name(system: str, old: Path, tmp_path: Path) -> None:
    copy = tmp_path / "b" / "copy"
    copy.write_bytes(b"of a run that was killed")
    mode = old.stat().st_mode
    assert operations.keep(old, copy) is (system != "other file system")
    operations.remove(old)
    assert (copy.read_bytes(), copy.stat().st_mode) == (b"old", mode)


def test_a_place_must_be_free(system: str, old: Path, tmp_path: Path) -> None:
    target = tmp_path / "b" / "target"
    operations.place(old, target)
    assert (names(old.parent), target.read_bytes()) == ([], b"old")
    old.write_bytes(b"newer")
    with pytest.raises(FileExistsError):
        operations.place(old, target)
    assert (old.read_bytes(), target.read_bytes()) == (b"newer", b"old")


def test_a_replacement_takes_the_place(system: str, old: Path, tmp_path: Path) -> None:
    target = tmp_path / "b" / "target"
    target.write_bytes(b"target")
    operations.replace(old, target)
    assert (names(old.parent), names(target.parent), target.read_bytes()) == ([], ["target"], b"old")


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux can")
def test_two_files_are_swapped(old: Path) -> None:
    other = old.with_name("other")
    other.write_bytes(b"other")
    assert operations.exchange(old, other)
    assert (old.read_bytes(), other.read_bytes()) == (b"other", b"old")
    with pytest.raises(FileNotFoundError):
        operations.exchange(old, old.with_name("none"))


def test_folders_go_only_if_they_are_empty(old: Path, tmp_path: Path) -> None:
    for name in ("a", "b", "none"):
        operations.remove_folder(tmp_path / name)
    assert names(tmp_path) == ["a"]
    operations.remove(old / "below a file")


linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells what a folder hands on")


@linux
def test_folders_that_hand_on_the_same_make_files_alike(old: Path, tmp_path: Path) -> None:
    assert operations.makes_alike(tmp_path / "a", tmp_path / "b")
    (tmp_path / "b").chmod(0o700)
    assert operations.makes_alike(tmp_path / "a", tmp_path / "b")
    assert not operations.makes_alike(tmp_path / "a", tmp_path / "none")


@linux
def test_folders_that_hand_on_a_group_or_an_attribute_make_other_files(old: Path, tmp_path: Path) -> None:
    (tmp_path / "b").chmod(0o2755)
    assert not operations.makes_alike(tmp_path / "a", tmp_path / "b")
    (tmp_path / "a").chmod(0o2755)
    assert operations.makes_alike(tmp_path / "a", tmp_path / "b")
    try:
        os.setxattr(tmp_path / "b", "user.label", b"x")
    except OSError:
        pytest.skip("this file system has no attributes")
    assert not operations.makes_alike(tmp_path / "a", tmp_path / "b")
    os.setxattr(tmp_path / "a", "user.label", b"x")
    assert operations.makes_alike(tmp_path / "a", tmp_path / "b")


@pytest.mark.parametrize("many", [False, True])
def test_a_few_files_are_synced_alone_and_many_together(old: Path, monkeypatch: pytest.MonkeyPatch, many: bool) -> None:
    calls: list[str] = []
    monkeypatch.setattr(os, "fsync", lambda descriptor: calls.append("one"))
    monkeypatch.setattr(os, "sync", lambda: calls.append("all"), raising=False)
    operations.sync([old, old.parent] * (operations.FEW if many else 1))
    assert calls == (["all"] if many else ["one", "one"])


@pytest.mark.parametrize("number", [0, 1, 5, operations.FEW])
def test_each_of_a_few_files_is_brought_to_the_disk(
    number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    paths = [tmp_path / str(n) for n in range(number)]
    for path in paths:
        path.write_bytes(b"x")
    synced: list[int] = []
    monkeypatch.setattr(os, "fsync", lambda descriptor: synced.append(os.fstat(descriptor).st_ino))
    operations.sync(paths)
    assert sorted(synced) == sorted(path.stat().st_ino for path in paths)


def test_all_files_are_on_their_way_before_the_first_is_waited_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[str] = []
    monkeypatch.setattr(operations, "_beginning", lambda: lambda descriptor: calls.append("begun"))
    monkeypatch.setattr(os, "fsync", lambda descriptor: calls.append("synced"))
    paths = [tmp_path / str(n) for n in range(5)]
    for path in paths:
        path.write_bytes(b"x")
    operations.sync(paths)
    assert calls == ["begun"] * 5 + ["synced"] * 5


def test_files_are_synced_without_threads_if_there_are_none_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise RuntimeError("can't start new thread")

    paths = [tmp_path / str(n) for n in range(7)]
    for path in paths:
        path.write_bytes(b"x")
    synced: list[int] = []
    monkeypatch.setattr(_thread, "start_new_thread", refuse)
    monkeypatch.setattr(os, "fsync", lambda descriptor: synced.append(os.fstat(descriptor).st_ino))
    operations.sync(paths)
    assert sorted(synced) == sorted(path.stat().st_ino for path in paths)


@pytest.mark.parametrize("when", ["begun", "synced"])
@pytest.mark.parametrize("number", range(5))
def test_what_the_disk_refuses_is_an_error(
    number: int, when: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    paths = [tmp_path / str(n) for n in range(5)]
    for path in paths:
        path.write_bytes(b"x")
    bad = paths[number].stat().st_ino

    def refuse(descriptor: int) -> None:
        if os.fstat(descriptor).st_ino == bad:
            raise OSError(errno.EIO, os.strerror(errno.EIO))

    if when == "begun":
        monkeypatch.setattr(operations, "_beginning", lambda: refuse)
    else:
        monkeypatch.setattr(os, "fsync", refuse)
    with pytest.raises(OSError, match=os.strerror(errno.EIO)):
        operations.sync(paths)


@pytest.mark.parametrize("missing", [0, 2, 4])
def test_a_file_that_cannot_be_brought_to_the_disk_is_named(missing: int, tmp_path: Path) -> None:
    paths = [tmp_path / str(n) for n in range(5)]
    for path in paths:
        path.write_bytes(b"x")
    paths[missing].unlink()
    with pytest.raises(FileNotFoundError) as caught:
        operations.sync(paths)
    assert caught.value.filename == str(paths[missing])
