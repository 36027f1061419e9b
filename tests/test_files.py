"""Writing whole or not at all, and never through links."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.diagnostics import OutputError
from urdfsync.files import Tree, commit, digest, remove_empty, templates_digest, text_digest


def test_line_endings_are_normalised_in_texts_only() -> None:
    assert text_digest(b"a\r\nb\rc\n") == text_digest(b"a\nb\nc\n") == digest(b"a\nb\nc\n")
    assert digest(b"a\r\n") != digest(b"a\n")


def test_commit_writes_and_deletes(tmp_path: Path) -> None:
    old, new = tmp_path / "old", tmp_path / "deep" / "new"
    old.write_text("old")
    commit({new: b"new"}, [old])
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == [new]
    assert new.read_bytes() == b"new"


def test_commit_keeps_the_permissions_of_a_file(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("old")
    file.chmod(0o640)
    commit({file: b"new"})
    assert file.stat().st_mode & 0o777 == 0o640


def test_commit_replaces_nothing_unless_all_can_be_written(tmp_path: Path) -> None:
    first = tmp_path / "first"
    first.write_text("old")
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(OutputError, match="can't be written"):
        commit({first: b"new", tmp_path / "file" / "second": b"new"})
    assert first.read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "first"]


def test_commit_does_not_write_through_what_an_interrupted_run_left(tmp_path: Path) -> None:
    target, elsewhere = tmp_path / "target", tmp_path / "elsewhere"
    elsewhere.write_text("precious")
    (tmp_path / ".target.urdfsync-tmp").symlink_to(elsewhere)
    commit({target: b"new"})
    assert elsewhere.read_text() == "precious"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["elsewhere", "target"]


def test_a_tree_reads_what_is_inside(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "file").write_bytes(b"text")
    tree = Tree(tmp_path)
    assert tree.read(tmp_path / "a" / "file") == b"text"
    assert tree.read(tmp_path / "a" / "none") is None
    assert tree.read(tmp_path / "none" / "file") is None


def test_a_tree_refuses_links_folders_and_what_is_outside(tmp_path: Path) -> None:
    root = tmp_path / "root"
    (root / "folder").mkdir(parents=True)
    (root / "link").symlink_to(tmp_path)
    (tmp_path / "secret").write_text("secret")
    (root / "file").symlink_to(tmp_path / "secret")
    tree = Tree(root)
    for path in (root / "link" / "secret", root / "file", root / "folder", tmp_path / "secret"):
        with pytest.raises(OutputError):
            tree.read(path)


def test_empty_folders_go_as_far_as_they_are_empty(tmp_path: Path) -> None:
    deep = tmp_path / "package" / "a" / "b"
    deep.mkdir(parents=True)
    (tmp_path / "package" / "file").touch()
    remove_empty([deep, tmp_path / "gone"], tmp_path)
    assert [path.name for path in (tmp_path / "package").iterdir()] == ["file"]


def test_templates_count_by_name_and_content(tmp_path: Path) -> None:
    own, ours = tmp_path / "own", tmp_path / "ours"
    for folder in (own, ours):
        folder.mkdir()
    (ours / "a.jinja").write_text("a")
    before = templates_digest([ours])
    assert templates_digest([own, ours]) == before
    (own / "a.jinja").write_text("a")
    (own / "notes.txt").write_text("no template")
    assert templates_digest([own, ours]) == before
    (own / "a.jinja").write_text("b")
    assert templates_digest([own, ours]) != before
