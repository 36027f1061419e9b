"""Reading files, never through links; errors in words."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from urdfsync.diagnostics import OutputError
from urdfsync.files import Tree, digest, failure, put, templates_digest, text_digest


def test_line_endings_are_normalised_in_texts_only() -> None:
    assert text_digest(b"a\r\nb\rc\n") == text_digest(b"a\nb\nc\n") == digest(b"a\nb\nc\n")
    assert digest(b"a\r\n") != digest(b"a\n")


@pytest.mark.parametrize(
    ("number", "hint"),
    [
        (errno.EACCES, "check the permissions of the file and of its folder; then build again"),
        (errno.EROFS, "mount it for writing"),
        (errno.ENOSPC, "free some space on the disk; then build again"),
        (errno.EISDIR, "move away what is in its place; then build again"),
        (errno.EIO, "then build again"),
    ],
)
def test_the_hint_fits_the_error(number: int, hint: str) -> None:
    (found,) = failure(OSError(number, os.strerror(number), "somewhere"), "Arm/Arm.mo").diagnostics
    assert (found.file, found.message) == ("Arm/Arm.mo", f"it can't be written: {os.strerror(number)}")
    assert hint in found.hint


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


def test_templates_count_by_name_and_content(tmp_path: Path) -> None:
    own, ours = tmp_path / "own", tmp_path / "ours"
    for folder in (own, ours):
        folder.mkdir()
    (ours / "a.jinja").write_text("a")
    before = templates_digest([ours])
    assert templates_digest([own, ours]) == before
    (own / "a.jinja").write_text("a")
    (own / ".a.jinja.swp").write_text("of an editor")
    assert templates_digest([own, ours]) == before
    (own / "a.jinja").write_text("b")
    assert templates_digest([own, ours]) != before


def test_a_file_that_a_template_may_include_counts_whatever_its_name(tmp_path: Path) -> None:
    (tmp_path / "header.txt").write_text("old")
    before = templates_digest([tmp_path])
    (tmp_path / "header.txt").write_text("new")
    assert templates_digest([tmp_path]) != before


def test_what_is_put_in_a_place_follows_no_link(tmp_path: Path) -> None:
    victim, place = tmp_path / "victim", tmp_path / "place"
    victim.write_bytes(b"precious")
    place.symlink_to(victim)
    put(place, b"new")
    assert (victim.read_bytes(), place.read_bytes(), place.is_symlink()) == (b"precious", b"new", False)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["place", "victim"]
