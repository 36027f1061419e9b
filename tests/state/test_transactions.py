"""All or nothing; crashes at each operation are in `test_crash`."""

from __future__ import annotations

import errno
import os
import sys
from pathlib import Path

import pytest

from urdfsync.diagnostics import OutputError, StateError
from urdfsync.files import digest
from urdfsync.state import operations
from urdfsync.state.batch import SavedError
from urdfsync.state.journal import FORMAT, Journal
from urdfsync.state.transactions import Change, Transactions, UnfinishedError


@pytest.fixture
def transactions(tmp_path: Path) -> Transactions:
    return Transactions(tmp_path, tmp_path / "state", lambda path: path.relative_to(tmp_path).as_posix())


@pytest.fixture
def changes(tmp_path: Path) -> list[Change]:
    """A file to renew, one to delete, one to make, and one that records it."""
    for name in ("renewed", "a/deleted"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(name.encode())
    return [
        Change(tmp_path / "renewed", b"new", digest(b"renewed")),
        Change(tmp_path / "a/deleted", None, digest(b"a/deleted")),
        Change(tmp_path / "b/c/made", b"made", None),
        Change(tmp_path / "record", b"record", None),
    ]


def contents(folder: Path) -> dict[str, bytes]:
    """All files and empty folders."""
    found = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*")}
    return {
        name: b"" if path.is_dir() else path.read_bytes()
        for name, path in found.items()
        if path.is_file() or (name not in ("state", "state/journal", "state/undo") and not any(path.iterdir()))
    }


DONE = {"renewed": b"new", "b/c/made": b"made", "record": b"record"}


def test_all_is_done(tmp_path: Path, transactions: Transactions, changes: list[Change]) -> None:
    transactions.apply("arm", changes, [tmp_path / "a"])
    assert contents(tmp_path) == DONE
    assert not transactions.pending()


def test_folders_that_are_not_empty_stay(tmp_path: Path, transactions: Transactions, changes: list[Change]) -> None:
    (tmp_path / "a/mine").write_bytes(b"mine")
    transactions.apply("arm", changes, [tmp_path / "a"])
    assert contents(tmp_path) == {**DONE, "a/mine": b"mine"}


@pytest.mark.parametrize("alike", [True, False])
def test_a_file_that_replaces_another_stands_apart_until_then(
    tmp_path: Path, transactions: Transactions, changes: list[Change], monkeypatch: pytest.MonkeyPatch, alike: bool
) -> None:
    """And has its permissions then; new files stand where they get what their folder hands on."""
    (tmp_path / "renewed").chmod(0o640)
    real, places = operations.write, []

    def write(path: str, content: bytes, like: str | None = None) -> None:
        places.append(Path(path).relative_to(tmp_path).parent.as_posix())
        real(path, content, like)

    monkeypatch.setattr(operations, "write", write)
    monkeypatch.setattr(operations, "makes_alike", lambda folder, other: alike)
    transactions.apply("arm", changes, [tmp_path / "a"])
    assert places == ["state/journal", "state/undo" if alike else ".", "b/c", "."]
    assert contents(tmp_path) == DONE
    assert (tmp_path / "renewed").stat().st_mode & 0o777 == 0o640


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="only root may give files to any group")
def test_a_file_gets_the_group_of_its_folder(tmp_path: Path, transactions: Transactions, changes: list[Change]) -> None:
    for folder in (tmp_path, tmp_path / "a"):
        os.chown(folder, -1, 4321)
        folder.chmod(0o2775)
    (tmp_path / "state").mkdir()
    os.chown(tmp_path / "state", -1, 0)
    (tmp_path / "state").chmod(0o755)
    transactions.apply("arm", changes)
    assert {(tmp_path / name).stat().st_gid for name in DONE} == {4321}


def test_a_journal_of_a_newer_urdfsync_is_left_alone(tmp_path: Path, transactions: Transactions) -> None:
    """So an older one, of which the format was lower, leaves alone what stands apart."""
    (tmp_path / "state/journal").mkdir(parents=True)
    journal = Journal("arm", "1", (), format=FORMAT + 1)
    (tmp_path / "state/journal/prepare.json").write_bytes(journal.dumps())
    before = contents(tmp_path)
    with pytest.raises(StateError) as caught:
        transactions.recover([], [])
    assert [found.code for found in caught.value.diagnostics] == ["newer-state"]
    assert contents(tmp_path) == before


@pytest.mark.parametrize("number", range(4))
def test_a_file_that_is_not_as_planned_stops_all(
    tmp_path: Path, transactions: Transactions, changes: list[Change], number: int
) -> None:
    mine = changes[number].path
    mine.parent.mkdir(parents=True, exist_ok=True)
    mine.write_bytes(b"mine")
    before = contents(tmp_path)
    with pytest.raises(SavedError) as caught:
        transactions.apply("arm", changes, [tmp_path / "a"])
    assert caught.value.path == mine
    assert contents(tmp_path) == before


def test_a_new_file_that_somebody_has_made_just_so_is_no_hindrance(
    tmp_path: Path, transactions: Transactions, changes: list[Change]
) -> None:
    (tmp_path / "b/c").mkdir(parents=True)
    (tmp_path / "b/c/made").write_bytes(b"made")
    transactions.apply("arm", changes, [tmp_path / "a"])
    assert contents(tmp_path) == DONE


def test_a_folder_in_the_way_stops_all(tmp_path: Path, transactions: Transactions, changes: list[Change]) -> None:
    (tmp_path / "record").mkdir()
    before = contents(tmp_path)
    with pytest.raises(SavedError):
        transactions.apply("arm", changes)
    assert contents(tmp_path) == before


def test_an_error_names_what_is_in_the_way(tmp_path: Path, transactions: Transactions, changes: list[Change]) -> None:
    before = contents(tmp_path)
    (tmp_path / "b").write_bytes(b"in the way")
    with pytest.raises(OutputError) as caught:
        transactions.apply("arm", changes)
    assert str(caught.value) == (
        "b: error: it can't be written: File exists; "
        "move away what is in its place; then build again [output-not-writable]"
    )
    assert contents(tmp_path) == {**before, "b": b"in the way"}


def test_what_cant_be_put_back_is_put_back_later(
    tmp_path: Path, transactions: Transactions, changes: list[Change], monkeypatch: pytest.MonkeyPatch
) -> None:
    before = contents(tmp_path)
    real = operations.place

    def fail(path: str, target: str) -> None:
        if Path(target).name in ("record", "deleted"):
            raise OSError(errno.EACCES, os.strerror(errno.EACCES), target)
        real(path, target)

    monkeypatch.setattr(operations, "place", fail)
    with pytest.raises(UnfinishedError) as caught:
        transactions.apply("arm", changes)
    assert [(found.file, found.code) for found in caught.value.diagnostics] == [
        ("record", "output-not-writable"),
        ("a/deleted", "unfinished"),
    ]
    assert transactions.pending()
    with pytest.raises(UnfinishedError):
        transactions.recover([], [])
    monkeypatch.undo()
    note = transactions.recover([], [])
    assert note is not None
    assert note.message == "the last build of robot `arm` was interrupted; it is undone, and starts again"
    assert contents(tmp_path) == before
    assert transactions.recover([], []) is None
