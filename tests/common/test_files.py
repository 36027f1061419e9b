"""Files: how they are shown and hashed, which ones are read, and that none stays half written."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from unittest import mock

import pytest

from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import (
    Tree,
    digest,
    failure,
    normalised,
    placed,
    put,
    shown,
    templates_digest,
    text_digest,
)


def test_paths_are_shown_as_they_are_seen_from_the_working_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    inside, beside = tmp_path / "cad" / "arm.urdf", tmp_path.with_name(f"{tmp_path.name}-2") / "arm.urdf"
    far, seen_beside = Path(tmp_path.anchor, "arm.urdf"), Path("..", beside.parent.name, "arm.urdf")
    seen = [".", str(Path("cad/arm.urdf")), str(seen_beside), str(far)]
    assert [shown(path) for path in (tmp_path, inside, beside, far)] == seen, "the shorter one"
    monkeypatch.setattr(os, "getcwd", mock.Mock(side_effect=FileNotFoundError))
    assert shown(inside) == str(inside), "somebody has deleted it"


def test_line_ends_make_no_difference_to_a_text() -> None:
    texts = (b"a\nb\n", b"a\r\nb\r\n", b"a\rb\r", b"a\r\nb\n")
    assert {normalised(text) for text in texts} == {texts[0]}
    assert len({text_digest(text) for text in texts}) == 1
    assert digest(texts[1]) != digest(texts[0]) == text_digest(texts[1])


def test_a_file_is_written_as_a_whole_or_not_at_all(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    put(folder / "a", b"first")
    monkeypatch.setattr(os, "replace", mock.Mock(side_effect=PermissionError))
    with pytest.raises(PermissionError):
        put(folder / "a", b"second")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"a": b"first"}


def test_templates_are_known_by_name_and_content_and_the_first_folder_counts(folder: Path) -> None:
    own, ours = folder / "own", folder / "ours"
    for path, text in {ours / "in/a": "1\n", ours / "b": "2", own / "in/a": "1\r\n", own / ".b": "x"}.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, newline="")
    assert templates_digest([own, ours]) == templates_digest([ours])
    (own / "b").write_text("3")
    assert templates_digest([own, ours]) != templates_digest([ours]) == templates_digest([ours, own])
    before = templates_digest([ours])
    (ours / "b").rename(ours / "c")
    assert templates_digest([ours]) != before


@pytest.fixture
def tree(folder: Path) -> Tree:
    """Files and links below `root`, and a file beside it."""
    (folder / "root/in").mkdir(parents=True)
    for path in ("root/a", "root/in/b", "outside"):
        Path(path).write_text(path)
    Path("root/link").symlink_to("a")
    Path("root/links").symlink_to("in")
    return Tree(folder / "root")


@pytest.mark.parametrize(("path", "content"), [("a", b"root/a"), ("in/b", b"root/in/b"), ("x", None), ("x/y", None)])
def test_files_of_a_tree_are_read(tree: Tree, path: str, content: bytes | None) -> None:
    assert tree.read(tree.root / path) == content


@pytest.mark.parametrize(("path", "code", "words"), [
    ("link", "output-in-the-way", "root/link: error: a symbolic link is where urdfsync would write a file"),
    ("in", "output-in-the-way", "root/in: error: a folder is where urdfsync would write a file"),
    ("links/b", "output-in-the-way", "root/links: error: a symbolic link is where a folder is needed"),
    ("a/b/c", "output-in-the-way", "root/a: error: a file is where a folder is needed"),
])  # fmt: skip
def test_what_is_in_the_way_is_refused(tree: Tree, path: str, code: str, words: str) -> None:
    with pytest.raises(OutputError) as caught:
        tree.read(tree.root / path)
    assert str(caught.value) == f"{words}; move it away [{code}]"


def test_a_path_does_not_leave_its_tree(tree: Tree) -> None:
    prefix = f"{tree.root}{os.sep}"
    assert (placed(prefix, "in/b"), placed(prefix, "../outside")) == (f"{prefix}in/b", f"{tree.root.parent}/outside")
    with pytest.raises(OutputError, match="the path leaves root"):
        tree.read(placed(prefix, "../outside"))


def test_what_the_system_refuses_has_a_hint() -> None:
    known, other = (failure(OSError(number, os.strerror(number)), Path("a")) for number in (errno.ENOSPC, errno.EIO))
    assert str(known).startswith(
        "a: error: it can't be written: No space left on device; free some space on the disk; "
    )
    assert str(other) == "a: error: it can't be written: Input/output error; then build again [output-not-writable]"
