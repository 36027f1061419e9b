"""Files that users take for a robot: what they are, and what to do with them."""

from __future__ import annotations

import gzip

import pytest

from urdfsync.engine.sources.file_kinds import find_conflict, find_kind

TAR = b"a.urdf".ljust(257, b"\0") + b"ustar"
KINDS = {
    "gzip": (gzip.compress(b"<robot/>", mtime=0), "compressed", "is packed by gzip", 1),
    "zip": (b"PK\x03\x04zip", "compressed", "is a zip archive", 1),
    "tar": (TAR, "compressed", "is a tar archive", 1),
    "parameters": (
        b"/**:\n  ros__parameters:\n    robot_description: |\n      <robot/>\n",
        "robot-description",
        "YAML",
        3,
    ),
    "quoted parameter": (b'{"robot_description": "<robot/>"}', "robot-description", "YAML", 1),
    "launch": (b"<!-- a -->\n<launch>\n<param name='robot_description'/></launch>", "launch-file", "not URDF", 2),
    "launch in Python": (b"from launch import LaunchDescription\n\ndef generate(): ...\n", "launch-file", "", 1),
    "launch in YAML": (b"%YAML 1.2\n---\nlaunch:\n\n- node:\n    pkg: a\n", "launch-file", "", 3),
    "pointer": (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "lfs-pointer", "Git LFS", 1),
}


@pytest.mark.parametrize(("content", "code", "words", "line"), KINDS.values(), ids=KINDS)
def test_what_is_no_robot_is_called_what_it_is(content: bytes, code: str, words: str, line: int) -> None:
    kind = find_kind(content)
    assert kind is not None
    assert (kind.code, kind.line) == (code, line)
    assert words in kind.message
    assert kind.hint


@pytest.mark.parametrize("content", [
    b"", b"<robot name='robot_description:'/>", b"<robot><launch/></robot>", b"<?xml?><!-- launch: --><robot/>",
    b"\n" * 20_000 + b"<launch/>", TAR.replace(b"\0", b" "),
])  # fmt: skip
def test_of_what_may_be_a_robot_nothing_is_said(content: bytes) -> None:
    assert find_kind(content) is None


@pytest.mark.parametrize(("text", "line"), [
    ("<robot>\n<<<<<<< HEAD\n<a/>\n=======\n>>>>>>> b\n", 2), ("<a/>\n>>>>>>> b", 2), ("<<<<<<<<<<", 1),
    ("<!-- <<<<<<< -->\n=======\n", 0), ("<<<<<<<x", 0),
])  # fmt: skip
def test_marks_of_a_merge_are_found(text: str, line: int) -> None:
    found = find_conflict(text)
    assert (found.line if found else 0) == line
