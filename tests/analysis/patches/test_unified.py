"""A patch as `git apply` reads it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from support.git import NEEDS_GIT

from urdfsync.analysis.patches.unified import unified


@NEEDS_GIT
@pytest.mark.parametrize("path", ["a.urdf", "a b/c.urdf", 'ä"\\.urdf', "tab\tname.urdf"])
@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"a\nb\nc\n", b"a\nB\nc\n"),
        (b"a\r\nb\r\nc", b"a\r\nB\r\nC"),
        (b"\xff\x85\x0c\x1c1\n" * 20, b"\xff\x85\x0c\x1c1\n" * 10 + b"2\n" + b"\xff\x85\x0c\x1c1\n" * 9),
        ("ä1\nb2\n".encode("utf-16"), "ä1\nb3\n".encode("utf-16")),
        (b"-1\n--- a\n+++ b\n", b"-1\n--- b\n+++ b\n"),
    ],
)
def test_git_applies_all_bytes(folder: Path, path: str, old: bytes, new: bytes) -> None:
    file = folder / path
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(old)
    subprocess.run(["git", "apply"], input=unified(path, old, new), check=True, cwd=folder)
    assert file.read_bytes() == new


def test_equal_contents_have_no_patch() -> None:
    assert unified("a.urdf", b"1\n", b"1\n") == b""
