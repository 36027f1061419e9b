"""Recognises files without a robot that users name as a source, such as an archive or a launch file."""

from __future__ import annotations

import re

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.modelica.markers import find_markers

_BEGINNING = 20_000
"""The bytes at the beginning of a file in which its kind is searched: the file may be long."""
_TAR = slice(257, 262)
_PACKED = (
    (b"\x1f\x8b", "packed by gzip", "gunzip < FILE > ROBOT.urdf"),
    (b"BZh", "packed by bzip2", "bunzip2 < FILE > ROBOT.urdf"),
    (b"\xfd7zXZ", "packed by xz", "unxz < FILE > ROBOT.urdf"),
    (b"\x28\xb5\x2f\xfd", "packed by zstd", "unzstd < FILE > ROBOT.urdf"),
    (b"PK\x03\x04", "a zip archive", "unzip FILE"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive", "7z x FILE"),
)
"""The first bytes of a packed file, the file's kind, and the command that unpacks it."""
_OTHERS = (
    ("lfs-pointer", rb"version https://git-lfs", "the file is a Git LFS pointer, not the robot"),
    ("robot-description", rb"[^<]*\brobot_description[\"']?[ \t]*:", "this is a parameter file of ROS: YAML, not URDF"),
    (
        "launch-file",
        rb"[^<]*\bLaunchDescription\b|(?m:[^<]*?^launch[ \t]*:)|(?s:(?>\s+|<\?.*?\?>|<!--.*?-->)*+)<launch\b",
        "this is a launch file of ROS, not URDF",
    ),
)
"""For each kind of file: its code, a pattern for its beginning, and a message."""
HINTS = {
    "compressed": "unpack it, and name the file in it",
    "lfs-pointer": "run `git lfs pull`",
    "robot-description": "save the text of `robot_description` as a file, and name that",
    "merge-conflict": "resolve the merge, then build again",
    "launch-file": "name the URDF or xacro file that it loads, and set `arguments` to the arguments that it passes",
}


def find_kind(content: bytes) -> Diagnostic | None:
    """Return an error about a file without a robot; None for a robot, and for an unknown kind of file."""
    packed = next((kind for kind in _PACKED if content.startswith(kind[0])), None)
    if content[_TAR] == b"ustar" and b"\0" in content[: _TAR.start]:
        packed = b"", "a tar archive", "tar xf FILE"
    if packed:
        hint = f"unpack it (`{packed[2]}`), and name the file in it"
        return Diagnostic(Severity.ERROR, "compressed", f"the file is {packed[1]}", line=1, hint=hint)
    for code, pattern, message in _OTHERS:
        if match := re.match(pattern, content[:_BEGINNING]):
            line = content.count(b"\n", 0, match.end()) + 1
            return Diagnostic(Severity.ERROR, code, message, line=line, hint=HINTS[code])
    return None


def find_conflict(text: str) -> Diagnostic | None:
    """Return an error at the first marker of a merge conflict, if there is one; line ends are unified."""
    code, message = "merge-conflict", "the file has merge conflict markers"
    for _, line in find_markers(text):
        return Diagnostic(Severity.ERROR, code, message, line=line, hint=HINTS[code])
    return None
