"""Files that only this machine believes."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from urdfsync.common.dependencies import localfile


def test_a_file_is_read_as_it_was_written_and_a_copy_is_no_file(tmp_path: Path) -> None:
    file = tmp_path / "notes/arm.json"
    localfile.replace(str(file), b"first\nsecond\0")
    assert localfile.read(file) == b"first\nsecond\0"
    shutil.copy2(file, tmp_path / "copy")
    assert localfile.read(tmp_path / "copy") is None
    file.rename(tmp_path / "moved")
    assert localfile.read(tmp_path / "moved") == b"first\nsecond\0"
    os.utime(tmp_path / "moved")
    assert localfile.read(tmp_path / "moved") is None


def test_what_is_no_such_file_is_none(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(tmp_path / "file")
    localfile.replace(str(tmp_path / "file"), b"")
    assert localfile.read(tmp_path / "file") == b""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "text").write_text("urdfsync 1 1\nforged")
    for name in ("link", "pipe", "text", "missing", ".", "file/below"):
        assert localfile.read(tmp_path / name) is None, name


def test_a_new_one_takes_the_place_of_an_older_one_or_there_is_none(tmp_path: Path) -> None:
    for content in (b"first", b"second"):
        localfile.replace(str(tmp_path / "file"), content)
        assert localfile.read(tmp_path / "file") == content
    localfile.replace(str(tmp_path / "missing/folder/file"), b"")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file"]
