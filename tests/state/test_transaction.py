"""A transaction: all is done, or what somebody saved meanwhile stays. Crashes at each operation are in `test_crash`."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from unittest import mock

import msgspec
import pytest
from support.crashes import CHANGES, Operation, before_each

from urdfsync.diagnostics import OutputError
from urdfsync.files import digest, shown
from urdfsync.state import file_operations, transaction
from urdfsync.state.transaction import FileChange, Transactions, UnfinishedError, Writes, is_interrupted, save


@pytest.fixture
def transactions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Transactions:
    monkeypatch.chdir(tmp_path)
    return Transactions(tmp_path, tmp_path / "state")


@pytest.fixture
def changes(tmp_path: Path) -> list[FileChange]:
    """A file to renew, one to delete, one to make, and one that records it."""
    for name in ("renewed.mo", "a/deleted.mo"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_bytes(name.encode())
    return [
        FileChange(tmp_path / "renewed.mo", b"new", digest(b"renewed.mo")),
        FileChange(tmp_path / "a/deleted.mo", None, digest(b"a/deleted.mo")),
        FileChange(tmp_path / "b/c/made.mo", b"made", None),
        FileChange(tmp_path / "state/robots/arm.json", b"record", None),
    ]


def writes(changes: Sequence[FileChange]) -> Writes:
    """All changes of a build whose last one is the record."""
    return Writes(files=tuple(changes[:-1]), record=tuple(changes[-1:]))


def contents(folder: Path) -> dict[str, bytes]:
    """All files and empty folders, but for planned hashes."""
    found = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*")}
    return {
        name: b"" if path.is_dir() else path.read_bytes()
        for name, path in found.items()
        if path.name != "planned.json" and (path.is_file() or not any(path.iterdir()))
    }


DONE = {"renewed.mo": b"new", "b/c/made.mo": b"made", "state/robots/arm.json": b"record"}
OVERTAKEN = {"renewed.mo": b"new", "b/c/made.mo": b"made", "state/robots": b""}
"""After a save in between, nothing is recorded."""


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="only root may give files to any group")
def test_a_file_gets_the_group_of_its_folder(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange]
) -> None:
    for folder in (tmp_path, tmp_path / "a"):
        os.chown(folder, -1, 4321)
        folder.chmod(0o2775)
    transactions.apply("arm", writes(changes))
    assert {(tmp_path / name).stat().st_gid for name in DONE} == {4321}


@pytest.mark.parametrize(("number", "is_folder"), [*((number, False) for number in range(4)), (0, True)])
def test_what_is_not_as_planned_stays(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], number: int, is_folder: bool
) -> None:
    mine = changes[number].path
    mine.parent.mkdir(parents=True, exist_ok=True)
    if is_folder:
        mine.unlink()
        mine.mkdir()
    else:
        mine.write_bytes(b"mine")
    applied = transactions.apply("arm", writes(changes), [tmp_path / "a"])
    assert applied.not_done == tuple(dict.fromkeys([mine, changes[3].path]))
    after = DONE if number == 3 else OVERTAKEN
    assert contents(tmp_path) == {**after, mine.relative_to(tmp_path).as_posix(): b"" if is_folder else b"mine"}


@pytest.mark.parametrize("number", [0, 2], ids=["a file is there", "a free name"])
def test_a_moved_text_that_finds_its_place_taken_is_kept(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], number: int
) -> None:
    changes[number] = msgspec.structs.replace(changes[number], content=b"moved", is_moved=True)
    place = changes[number].path
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_bytes(b"mine")
    (said,) = transactions.apply("arm", writes(changes)).diagnostics
    assert (place.read_bytes(), place.with_name(f"{place.name}.saved").read_bytes()) == (b"mine", b"moved")
    assert said.code == "kept-save"
    assert f"{place.name}.saved" in said.message


@pytest.mark.parametrize("place", ["../victim.mo", "linked/victim.mo"])
def test_nothing_is_written_outside(tmp_path: Path, changes: list[FileChange], place: str) -> None:
    root = tmp_path / "a"
    (root / "linked").symlink_to(tmp_path)
    before = contents(tmp_path)
    with pytest.raises(OutputError):
        Transactions(root, root / "state").apply("arm", writes([FileChange(root / place, b"", None)]))
    assert contents(tmp_path) == before


def test_a_power_failure_at_any_moment_loses_nothing(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What takes a place is on the disk, the planned hashes are before anything changes, and all is in the end."""
    state, at_risk = tmp_path / "state", set[Path]()

    def before(name: str, then: Callable[..., None]) -> None:
        real = getattr(file_operations, name)

        def operation(*arguments: Any) -> None:
            then(*arguments)
            real(*arguments)

        monkeypatch.setattr(file_operations, name, operation)

    def take_place(path: str, target: str) -> None:
        folder = Path(target).parent
        assert Path(path) not in at_risk
        assert folder == state or state not in at_risk
        assert Path(path).name != "deleted.mo" or (tmp_path / "b/c/made.mo").exists(), "deletions come last"
        at_risk.add(folder)

    for name in ("write", "write_local"):
        before(name, lambda path, *_: at_risk.add(Path(path)))
    for name in ("exchange", "place", "replace"):
        before(name, take_place)
    before("sync", lambda paths: at_risk.difference_update(map(Path, paths)))
    transactions.apply("arm", writes(changes))
    assert at_risk == set()


def test_a_file_of_the_users_is_saved_to_the_disk_before_it_takes_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.mo").write_text("old")
    operations = mock.Mock()
    for name in ("write", "sync", "exchange"):
        monkeypatch.setattr(file_operations, name, mock.Mock(wraps=getattr(file_operations, name)))
        operations.attach_mock(getattr(file_operations, name), name)
    transaction.save(tmp_path / "a.mo", b"old", b"new")
    assert [call[0] for call in operations.mock_calls][:3] == ["write", "sync", "exchange"]
    assert (tmp_path / "a.mo").read_text() == "new"


@pytest.mark.parametrize("name", [transaction.PLANNED, transaction.DRAFT])
def test_planned_hashes_are_no_link(tmp_path: Path, transactions: Transactions, name: str) -> None:
    (tmp_path / "state").mkdir()
    (tmp_path / "state" / name).symlink_to(tmp_path / "nothing")
    assert transactions.is_pending()
    with pytest.raises(OutputError, match="symbolic link"):
        transactions.recover()


def test_what_cant_be_written_leaves_no_trace(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "state").mkdir()
    before = contents(tmp_path)
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    monkeypatch.setattr(file_operations, "write", mock.Mock(side_effect=full))
    with pytest.raises(OutputError, match="No space left"):
        transactions.apply("arm", writes(changes))
    assert contents(tmp_path) == before


def test_what_cant_be_finished_is_finished_later(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], monkeypatch: pytest.MonkeyPatch
) -> None:
    real = file_operations.place

    def fail(path: str, target: str) -> None:
        if target.endswith("made.mo"):
            raise OSError(errno.EACCES, os.strerror(errno.EACCES), str(target))
        real(path, target)

    monkeypatch.setattr(file_operations, "place", fail)
    for attempt in (lambda: transactions.apply("arm", writes(changes), [tmp_path / "a"]), transactions.recover):
        with pytest.raises(UnfinishedError) as caught:
            attempt()
        assert [(found.file, found.code) for found in caught.value.diagnostics] == [("b/c/made.mo", "unfinished")]
        assert is_interrupted(tmp_path / "state")
    monkeypatch.undo()
    (note,) = transactions.recover()
    assert note.message == "the last build of robot `arm` was interrupted; it is finished"
    assert contents(tmp_path) == DONE
    assert transactions.recover() == ()


def test_planned_hashes_that_were_cut_short_before_anything_changed_leave_no_trace(
    tmp_path: Path, transactions: Transactions
) -> None:
    (tmp_path / "state").mkdir()
    (tmp_path / "state" / transaction.DRAFT).write_bytes(b'{"robot": "cut sh')
    assert transactions.is_pending()
    assert transactions.recover() == ()
    assert not transactions.is_pending()


@pytest.mark.parametrize("can_exchange", [True, False])
@pytest.mark.parametrize("replaces", [True, False])
def test_a_file_that_no_build_owns_is_not_lost_either(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, can_exchange: bool, replaces: bool
) -> None:
    """However somebody saves it, and whatever the file system can do."""
    file, once = tmp_path / "mine.toml", iter(["save"])
    if not can_exchange:
        monkeypatch.setattr(file_operations, "rename", lambda path, target, flag: False)

    def save_before(found: Operation) -> None:
        if found.name == "exchange" and next(once, None):
            (tmp_path / "new").write_text("saved")
            if replaces:
                (tmp_path / "new").replace(file)
            else:
                file.write_text("saved")

    file.write_text("old")
    with before_each(save_before), pytest.raises(OutputError, match="somebody saved this file meanwhile"):
        save(file, b"old", b"new")
    assert file.read_text() == "saved"
    save(file, b"saved", b"new")
    assert file.read_text() == "new"
    assert {path.name for path in tmp_path.iterdir()} <= {"mine.toml", "new"}


def test_of_two_saves_in_between_the_earlier_one_is_kept_beside_the_file(tmp_path: Path) -> None:
    file, saves = tmp_path / "mine.toml", iter(["first", "second"])

    def save_before(found: Operation) -> None:
        if found.name == "exchange" and (text := next(saves, None)):
            file.write_text(text)

    file.write_text("old")
    with before_each(save_before), pytest.raises(OutputError) as error:
        save(file, b"old", b"new")
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {
        "mine.toml": "second",
        "mine.toml.saved": "first",
    }
    (found,) = error.value.diagnostics
    assert found.hint == f"an earlier save is kept as {shown(tmp_path / 'mine.toml.saved')}; run the command again"


def test_a_full_disk_leaves_a_file_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("old")
    monkeypatch.setattr(os, "write", mock.Mock(side_effect=OSError(errno.ENOSPC, "No space left on device")))
    with pytest.raises(OSError, match="No space"):
        save(file, b"old", b"new")
    assert contents(tmp_path) == {"mine.toml": b"old"}


def test_bases_are_there_first_and_go_last_and_the_record_comes_after_all(
    tmp_path: Path, transactions: Transactions
) -> None:
    paths = [tmp_path / name for name in ("base", "Arm.mo", "Old.mo", "old base", "record")]
    for path in paths[2:4]:
        path.write_bytes(b"old")
    base, file, record = (FileChange(path, b"new", None) for path in (paths[0], paths[1], paths[4]))
    old_file, old_base = (FileChange(path, None, digest(b"old")) for path in paths[2:4])
    order: list[Path] = []

    def note(operation: Operation) -> None:
        if operation.name in CHANGES:
            order.extend(path for path in operation.paths if path in paths)

    with before_each(note):
        transactions.apply("arm", Writes((old_base, base), (old_file, file), (record,)))
    assert order == paths


def test_what_is_written_through_an_open_handle_takes_its_place_again(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange]
) -> None:
    """The old file was exchanged already when its editor saves it."""
    with changes[0].path.open("r+b", buffering=0) as handle:

        def write(operation: Operation) -> None:
            if changes[1].path in operation.paths:
                handle.write(b"mine")

        with before_each(write):
            applied = transactions.apply("arm", writes(changes))
    assert applied.not_done == (changes[0].path, changes[3].path)
    assert changes[0].path.read_bytes().startswith(b"mine")


@pytest.mark.parametrize(("number", "name"), [(0, "exchange"), (1, "replace")])
def test_of_saves_between_look_and_change_the_last_counts(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], number: int, name: str
) -> None:
    path, saves = changes[number].path, iter([b"first", b"second"])

    def save(operation: Operation) -> None:
        if operation.name == name and path in operation.paths and (text := next(saves, None)):
            path.write_bytes(text)

    with before_each(save):
        applied = transactions.apply("arm", writes(changes))
    assert applied.not_done == (path, changes[3].path)
    assert path.read_bytes() == (b"first" if number else b"second"), "a deletion is not tried again"


def test_an_overtaken_build_leaves_no_planned_hashes(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange]
) -> None:
    changes[0].path.write_bytes(b"mine")
    assert transactions.apply("arm", writes(changes)).not_done
    assert not is_interrupted(tmp_path / "state")
