"""Reads files: computes hashes, refuses links and irregular files, and describes errors."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import stat
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from urdfsync.common import system
from urdfsync.common.dependencies.facts import Facts, read_unrecorded
from urdfsync.common.dependencies.places import label
from urdfsync.common.dependencies.reads import depend_on, file_type, read_file, read_stat, unrecorded, walk_files
from urdfsync.common.diagnostics import OutputError

TEMPORARY = ".urdfsync-tmp"
"""Suffix of new files that will replace their targets."""

_HINTS = {
    **dict.fromkeys((errno.EACCES, errno.EPERM), "check the permissions of the file and of its folder"),
    errno.EROFS: "the file system can't be written to: mount it for writing, or name another output folder",
    **dict.fromkeys((errno.ENOSPC, errno.EDQUOT), "free some space on the disk"),
    **dict.fromkeys((errno.EISDIR, errno.ENOTDIR, errno.EEXIST, errno.ENOTEMPTY), "move away what is in its place"),
    **dict.fromkeys((errno.ENAMETOOLONG, errno.EINVAL), "choose a shorter or plainer name for it"),
}

_LONGEST_PATH = 259
"""The length of a path that each Windows allows."""


def shown(path: str | Path) -> str:
    """Return a path for messages, as a user would type it: relative to the working folder if that is shorter.

    A file of a revision is named as by git: `HEAD:arm.urdf`.
    """
    text = str(path)
    revision = label(text)
    try:
        current = os.getcwd()  # noqa: PTH109 - every message calls this, and a Path takes five times as long
    except FileNotFoundError:  # it was deleted
        return text
    inside = os.path.join(current, "")  # noqa: PTH118
    if os.path.normcase(text).startswith(os.path.normcase(inside)):
        return revision + text[len(inside) :]
    return revision + (min(relative(text, current), text, key=len) if os.path.isabs(text) else text)  # noqa: PTH117


def relative(path: str | Path, folder: str | Path) -> str:
    """Return a path from a folder; an absolute path if it is on another drive of Windows."""
    try:
        return os.path.relpath(path, folder)
    except ValueError:
        return os.path.abspath(path)  # noqa: PTH100


def digest(content: bytes) -> str:
    """Return the SHA-256 (hex) of bytes as they are."""
    return hashlib.sha256(content).hexdigest()


def text_digest(content: bytes) -> str:
    r"""Return the SHA-256 (hex) of a file's bytes; in a text, `\r\n` and `\r` count as `\n`."""
    return digest(normalised(content))


def text_hash(content: bytes) -> str:
    """Return the hash of a file of a package: 16 digits, enough to tell the files of one robot apart."""
    return text_digest(content)[:16]


def normalised(content: bytes) -> bytes:
    r"""Return a text's bytes with `\r\n` and `\r` as `\n`; a content with a NUL is no text, for git as well."""
    if b"\r" not in content or b"\0" in content:
        return content
    return content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def put(file: Path, content: bytes) -> None:
    """Write a file outside of packages and state, as a whole or not at all. Raises OSError."""
    temporary = file.with_name(f".{file.name}-{os.urandom(8).hex()}{TEMPORARY}")
    try:
        with temporary.open("xb") as new:  # follows no link in its place
            new.write(content)
        system.replace(temporary, file)
    finally:
        with contextlib.suppress(OSError):  # the file may not exist
            temporary.unlink(missing_ok=True)


class Templates(NamedTuple):
    """Folders of templates, best first, and the hash of their contents.

    The last folder is the domain's; other folders are the user's.
    """

    folders: tuple[Path, ...]
    digest: str


def templates_digest(folders: Sequence[Path]) -> str:
    """Return the SHA-256 (hex) of names and contents of the templates in use; hidden files are left out.

    A template hides templates of the same name in later folders. The last folder is the program's.
    """
    templates: dict[str, str] = {}
    for folder in reversed(folders):
        above = len(str(folder)) + 1
        # the templates of domains are part of the program
        with unrecorded() if folder is folders[-1] else contextlib.nullcontext():
            for path in walk_files(folder):
                name = path[above:].replace(os.sep, "/")
                if not name.rpartition("/")[2].startswith("."):
                    templates[name] = text_digest(read_file(path))
    lines = [f"{name}\0{content}\n" for name, content in sorted(templates.items())]
    return digest("".join(lines).encode(errors="surrogateescape"))


def failure(error: OSError, path: str | Path, what: str = "it can't be written") -> OutputError:
    """Return an error of the system about a file or folder, with a hint."""
    hint = "; ".join(filter(None, [_hint(error, path), "then build again"]))
    message = f"{what}: {reason(error)}"
    return OutputError.of("output-not-writable", message, shown(path), hint=hint)


def reason(error: OSError) -> str:
    """Return why a file can't be read or written, in words."""
    return error.strerror or str(error)


def _hint(error: OSError, path: str | Path) -> str:
    if system.IS_WINDOWS and len(str(path)) > _LONGEST_PATH:
        return "choose shorter names, or allow long paths in Windows (LongPathsEnabled)"
    return system.held_hint(error) or _HINTS.get(error.errno or 0, "")


def kind_of(mode: int) -> str:
    """Return the kind of a file that is not regular, in words; `mode` is that of `os.lstat`."""
    return "a symbolic link" if stat.S_ISLNK(mode) else "a folder" if stat.S_ISDIR(mode) else "no regular file"


def placed(prefix: str, key: str) -> str:
    """Return a file's path by its POSIX path from a folder; `prefix` is the folder with a final separator.

    This is faster than pathlib for thousands of paths: hardly any path contains `.` or `..`.
    """
    if ".." in key or os.sep != "/":
        return os.path.normpath(os.path.join(prefix, key))  # noqa: PTH118 - on Windows, the key may have a drive
    return prefix + key


class Tree:
    """The files below `root`; no path may leave `root`, not even through a symbolic link.

    This looks at each folder once: only another `Tree` finds folders that are made later.
    """

    def __init__(self, root: Path) -> None:
        self.root = root
        self._below = os.path.join(root, "")  # noqa: PTH118 - strings: there are thousands of files
        self._checked = {str(root): True}

    def covers(self, path: str | os.PathLike[str]) -> bool:
        """Whether a path is below the root; a string must be absolute, without `..`."""
        return os.fspath(path).startswith(self._below)

    def read(self, path: str | os.PathLike[str], facts: Facts = ()) -> bytes | None:
        """Read a file below the root; None if there is none.

        A string as path must be absolute, without `..`. `facts` are those of `read_stat`, if they are known.

        Raises OutputError for a link, for another irregular file, and for an unreadable one.
        """
        path = os.fspath(path)
        if not self.check_folder(path.rpartition(os.sep)[0]):
            depend_on(path)  # a build may make the folder
            return None
        try:
            mode = (facts or read_stat(path))[0]
            if not mode:
                return None
            if stat.S_ISREG(mode):
                return read_unrecorded(path)
        except (FileNotFoundError, NotADirectoryError):
            return None  # somebody deleted the file meanwhile
        except OSError as error:
            raise _refusal(
                "output-unreadable", path, f"it can't be read: {reason(error)}", _hint(error, path)
            ) from None
        message = f"{kind_of(mode)} is where urdfsync would write a file"
        raise _refusal("output-in-the-way", path, message, "move it away")

    def check_folder(self, folder: str | os.PathLike[str]) -> bool:
        """Whether a folder below the root exists. Raises OutputError if it is a file, a link, or not below the root."""
        folder = os.fspath(folder)
        if folder in self._checked:
            return self._checked[folder]
        if not self.covers(folder):
            raise _refusal("outside", folder, f"the path leaves {shown(self.root)}")
        self.check_folder(os.path.dirname(folder))  # noqa: PTH120
        mode = file_type(folder, follow=False)
        if mode and not stat.S_ISDIR(mode):
            what = "a symbolic link" if stat.S_ISLNK(mode) else "a file"
            raise _refusal("output-in-the-way", folder, f"{what} is where a folder is needed", "move it away")
        self._checked[folder] = bool(mode)
        return bool(mode)


def _refusal(code: str, path: str, message: str, hint: str = "") -> OutputError:
    return OutputError.of(code, message, shown(Path(path)), hint=hint)
