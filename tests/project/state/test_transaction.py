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

from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import digest, shown
from urdfsync.project.state import file_operations, transaction
from urdfsync.project.state.transaction import UNFINISHED, FileChange, Transactions, Writes, find_leftovers, save


@pytest.fixture
def transactions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Transactions:
    monkeypatch.chdir(tmp_path)
    return Transactions(tmp_path)


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
    """All files and empty folders."""
    found = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*")}
    return {
        name: b"" if path.is_dir() else path.read_bytes()
        for name, path in found.items()
        if path.is_file() or not any(path.iterdir())
    }


DONE = {"renewed.mo": b"new", "b/c/made.mo": b"made", "state/robots/arm.json": b"record"}


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="only root may give files to any group")
def test_a_file_gets_the_group_of_its_folder(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange]
) -> None:
    for folder in (tmp_path, tmp_path / "a"):
        os.chown(folder, -1, 4321)
        folder.chmod(0o2775)
    transactions.apply(writes(changes))
    assert {(tmp_path / name).stat().st_gid for name in DONE} == {4321}


@pytest.mark.parametrize(("number", "is_folder"), [*((number, False) for number in range(4)), (0, True)])
def test_what_is_not_as_planned_stays_and_nothing_follows(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], number: int, is_folder: bool
) -> None:
    mine = changes[number].path
    mine.parent.mkdir(parents=True, exist_ok=True)
    if is_folder:
        mine.unlink()
        mine.mkdir()
    else:
        mine.write_bytes(b"mine")
    before = contents(tmp_path)
    assert transactions.apply(writes(changes), [tmp_path / "a"]).overtaken == mine
    done = {name: DONE[name] for name in [*DONE][: {0: 0, 2: 1, 1: 2, 3: 2}[number]]}
    kept = {name: content for name, content in before.items() if number != 3 or name != "a/deleted.mo"}
    assert contents(tmp_path) == {**kept, **done}


@pytest.fixture
def texts(tmp_path: Path) -> dict[str, str]:
    """Three edited files, and the hash of each."""
    for name in ("a", "b", "c"):
        (tmp_path / f"{name}.mo").write_text(f"edited {name}")
    return {name: digest(f"edited {name}".encode()) for name in ("a", "b", "c")}


MOVES = {
    "free": {"d": "a"},
    "exchange": {"a": "b", "b": "a"},
    "cycle": {"a": "b", "b": "c", "c": "a"},
    "shift": {"b": "a", "c": "b", "d": "c"},
}
"""The former name of each moved file by its new one."""


def moved(folder: Path, texts: dict[str, str], origins: dict[str, str]) -> Writes:
    """The changes of files that move, and the deletions of old places."""
    place = {name: folder / f"{name}.mo" for name in "abcd"}
    made = [FileChange(place[new], f"moved {old}".encode(), texts.get(new), place[old]) for new, old in origins.items()]
    gone = [FileChange(place[old], None, texts[old]) for old in {*origins.values()} - origins.keys()]
    return Writes(files=(*made, *gone))


@pytest.mark.parametrize("can_exchange", [pytest.param(True, marks=pytest.mark.posix("two files trade places")), False])
@pytest.mark.parametrize("origins", MOVES.values(), ids=MOVES)
def test_an_edited_file_that_moves_is_in_a_visible_place_at_each_moment(
    tmp_path: Path,
    transactions: Transactions,
    texts: dict[str, str],
    origins: dict[str, str],
    can_exchange: bool,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if not can_exchange:
        monkeypatch.setattr(file_operations, "rename", lambda path, target, flag: False)

    def look(operation: Operation) -> None:
        if operation.name in CHANGES and can_exchange:
            found = sorted(path.read_text().rpartition(" ")[2] for path in tmp_path.glob("?.mo"))
            assert found == ["a", "b", "c"]

    with before_each(look):
        assert transactions.apply(moved(tmp_path, texts, origins)).overtaken is None
    stayed = {name: f"edited {name}" for name in texts.keys() - origins.keys() - {*origins.values()}}
    after = {f"{name}.mo": text for name, text in {**stayed, **{n: f"moved {o}" for n, o in origins.items()}}.items()}
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == after


@pytest.mark.parametrize("saved", ["a", "d"])
def test_a_save_at_either_end_of_a_move_stops_it(
    tmp_path: Path, transactions: Transactions, texts: dict[str, str], saved: str
) -> None:
    once = iter([b"mine"])

    def save(operation: Operation) -> None:
        if operation.name == "place" and (content := next(once, None)):
            (tmp_path / f"{saved}.mo").write_bytes(content)

    with before_each(save):
        assert transactions.apply(moved(tmp_path, texts, MOVES["free"])).overtaken == tmp_path / "d.mo"
    wanted = {"a": "edited a", "b": "edited b", "c": "edited c", saved: "mine"}
    assert {path.stem: path.read_text() for path in tmp_path.iterdir()} == wanted


LEFT = {
    "half a new file": ("X.mo.{old}-{new}", "ne", "old", ""),
    "half a new file at the new path of an edit": ("X.mo.{old}-{new}+m", "ne", "other", ""),
    "a caught save there": ("X.mo.{old}-{new}+m", "saved", "new", "X.mo.saved"),
    "half a first file": ("X.mo.none-{new}", "ne", None, ""),
    "a new file": ("X.mo.{old}-{new}", "new", "old", ""),
    "the old file": ("X.mo.{old}-{new}", "old", "new", ""),
    "a deleted file": ("X.mo.{old}-none", "old", None, ""),
    "the old file, and a later save": ("X.mo.{old}-{new}", "old", "saved", ""),
    "a caught save": ("X.mo.{old}-{new}", "saved", "new", "X.mo.saved"),
    "a save of a deleted file": ("X.mo.{old}-none", "saved", None, "X.mo.saved"),
    "one of three renames": ("X.mo.{old}-{new}", "old", None, "X.mo"),
    "two of three renames of a move": ("X.mo.{old}-moves", "old", "new", "X.mo.saved"),
}


@pytest.mark.parametrize(("name", "content", "present", "kept"), LEFT.values(), ids=LEFT)
def test_a_temporary_name_says_what_becomes_of_the_file(
    tmp_path: Path, transactions: Transactions, name: str, content: str, present: str | None, kept: str
) -> None:
    old, new = digest(b"old")[:12], digest(b"new")[:12]
    name, _, mark = name.partition("+")
    (tmp_path / f".{name.format(old=old, new=new)}.abcdef{mark}.urdfsync-tmp").write_text(content)
    if present:
        (tmp_path / "X.mo").write_text(present)
    said = transactions.clear(find_leftovers([tmp_path]))
    wanted = ({"X.mo": present} if present else {}) | ({kept: content} if kept else {})
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == wanted
    assert [found.code for found in said] == ["kept-save"] * kept.endswith(".saved")


@pytest.mark.parametrize("place", ["../victim.mo", "linked/victim.mo"])
def test_nothing_is_written_outside(tmp_path: Path, changes: list[FileChange], place: str) -> None:
    root = tmp_path / "a"
    (root / "linked").symlink_to(tmp_path)
    before = contents(tmp_path)
    with pytest.raises(OutputError):
        Transactions(root).apply(writes([FileChange(root / place, b"", None)]))
    assert contents(tmp_path) == before


def test_a_power_failure_at_any_moment_loses_nothing(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What takes a place is on the disk, bases are before files change, files before the record, and all in the end."""
    at_risk = set[Path]()

    def before(name: str, then: Callable[..., None]) -> None:
        real = getattr(file_operations, name)

        def operation(*arguments: Any) -> None:
            then(*arguments)
            real(*arguments)

        monkeypatch.setattr(file_operations, name, operation)

    def take_place(path: str, target: str) -> None:
        folder = Path(target).parent
        assert Path(path) not in at_risk
        assert folder == tmp_path / "bases" or tmp_path / "bases" not in at_risk
        assert folder != tmp_path / "state/robots" or not at_risk
        assert Path(path).name != "deleted.mo" or (tmp_path / "b/c/made.mo").exists(), "deletions come late"
        at_risk.add(folder)

    before("write", lambda path, *_: at_risk.add(Path(path)))
    for name in ("exchange", "place", "replace"):
        before(name, take_place)
    before("sync", lambda paths: at_risk.difference_update(map(Path, paths)))
    base = FileChange(tmp_path / "bases/a", b"base", None)
    transactions.apply(msgspec.structs.replace(writes(changes), before=(base,)))
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


def test_what_cant_be_written_leaves_no_trace(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "state").mkdir()
    before = contents(tmp_path)
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    monkeypatch.setattr(file_operations, "write", mock.Mock(side_effect=full))
    with pytest.raises(OutputError, match="No space left"):
        transactions.apply(writes(changes))
    assert contents(tmp_path) == before


def test_an_error_in_between_tells_how_many_files_are_written(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange], monkeypatch: pytest.MonkeyPatch
) -> None:
    real = file_operations.place

    def fail(path: str, target: str) -> None:
        if target.endswith("made.mo"):
            raise OSError(errno.EACCES, os.strerror(errno.EACCES), str(target))
        real(path, target)

    monkeypatch.setattr(file_operations, "place", fail)
    with pytest.raises(OutputError) as caught:
        transactions.apply(writes(changes), [tmp_path / "a"])
    assert [(found.file, found.code, found.message) for found in caught.value.diagnostics] == [
        (str(Path("b/c/made.mo")), UNFINISHED, "1 of 4 files are written, then: Permission denied")
    ]
    assert contents(tmp_path) == {"renewed.mo": b"new", "a/deleted.mo": b"a/deleted.mo"}
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    transactions.apply(writes(changes[1:]), [tmp_path / "a"])
    assert contents(tmp_path) == DONE


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
        transactions.apply(Writes((old_base, base), (old_file, file), (record,)))
    assert order == paths


@pytest.mark.posix("a file that is open can be replaced")
def test_what_is_written_through_an_open_handle_takes_its_place_again(
    tmp_path: Path, transactions: Transactions, changes: list[FileChange]
) -> None:
    """The old file was exchanged already when its editor saves it."""
    with changes[0].path.open("r+b", buffering=0) as handle:

        def write(operation: Operation) -> None:
            if changes[1].path in operation.paths:
                handle.write(b"mine")

        with before_each(write):
            applied = transactions.apply(writes(changes))
    assert applied.overtaken == changes[0].path
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
        applied = transactions.apply(writes(changes))
    assert applied.overtaken == path
    assert path.read_bytes() == (b"first" if number else b"second"), "a deletion is not tried again"
