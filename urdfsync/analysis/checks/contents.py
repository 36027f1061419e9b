"""The contents of packages, libraries and programs: read, copied for compilers, hashed for the keys of results.

A library may be a stranger's. So links to folders or out of the library are refused, and a copy has a limit.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
from collections.abc import Collection
from pathlib import Path

from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import OutputError, UrdfsyncError
from urdfsync.common.files import shown

MOST_BYTES = 2**29
"""The greatest number of bytes of one copy on disk; the Modelica Standard Library without its resources has 15 MB."""
RESOURCES = "Resources"
"""The folder of a library that holds no Modelica."""
_BLOCK = 4096
"""Bytes that a file takes on disk at least."""


def content_hash(root: Path, without: Collection[str] = ()) -> str:
    """Return the SHA-256 (hex) over a file, or over the names and contents of all files below a folder.

    Ignores hidden files, Python's caches, and files and folders with one of the names `without`. An unreadable file
    counts as empty: no compiler can read it. Raises UrdfsyncError for a symbolic link to a folder, or to a file outside
    of `root`.
    """
    # strings take half the time of paths: a library has 3,000 files
    top, files, hashed = os.path.realpath(root), list[str](), hashlib.sha256()
    if not os.path.isdir(top):  # noqa: PTH112
        files.append(top)
    for folder, folders, names in os.walk(top):
        for inside in (folders, names):
            inside[:] = sorted(name for name in inside if name[0] != "." and name not in ("__pycache__", *without))
            for path in (os.path.join(folder, name) for name in inside):  # noqa: PTH118
                if os.path.islink(path):  # noqa: PTH114
                    _refuse_bad_link(top, path)
        files += (os.path.join(folder, name) for name in names)  # noqa: PTH118
    for path in files:
        content = b""
        with contextlib.suppress(OSError):
            if os.path.isfile(path):  # noqa: PTH113 - a pipe would never end
                with open(path, "rb") as file:  # noqa: PTH123
                    content = hashlib.file_digest(file, "sha256").digest()
        hashed.update(f"{path[len(top) :]}\0".encode(errors="surrogateescape") + content)
    return hashed.hexdigest()


def _refuse_bad_link(top: str, link: str) -> None:
    """Raise UrdfsyncError for a link that does not lead to a file of its library."""
    target, problem = os.path.realpath(link), ""
    if not target.startswith(os.path.join(top, "")):  # noqa: PTH118
        problem = "the link leads out of its library"
    elif os.path.isdir(target):  # noqa: PTH112
        problem = "the link leads to a folder"
    if problem:
        raise _refusal(Path(link), problem, "replace the link by the files themselves")


def copy_library(root: Path, target: Path) -> None:
    """Copy a library, which is a folder or a file.

    Raises UrdfsyncError for a symbolic link to a folder or out of the library, and for a library that is too large.
    """
    top, size = os.path.realpath(root), 0

    def ignored(folder: str, names: list[str]) -> list[str]:
        for path in (Path(folder, name) for name in names):
            if path.is_symlink():
                _refuse_bad_link(top, str(path))
        return []

    def copy(source: str, place: str) -> str:
        nonlocal size
        size += max(_BLOCK, os.stat(source).st_size)  # noqa: PTH116
        if size > MOST_BYTES:
            message = f"the library takes more than {MOST_BYTES // 2**20} MB, and has to be copied for the compiler"
            raise _refusal(root, message, "take large resources out of the library")
        return shutil.copyfile(source, place)

    if root.is_dir():
        shutil.copytree(top, target, ignore=ignored, copy_function=copy)
    else:
        copy(top, str(target))


def _refusal(path: Path, message: str, hint: str) -> UrdfsyncError:
    return UrdfsyncError.of("library-not-copied", message, shown(path), hint=hint)


def package_texts(folder: Path, top: Path | None = None, without: Collection[Path] = ()) -> dict[str, bytes]:
    """Read the Modelica files of a package and its subpackages, by their path below `top`, by default `folder`.

    Folders in `without` are left out. Only regular files and links to them count: a pipe must not be opened, and links
    to folders may go in circles. Raises OutputError for a file or a folder that can't be read.
    """
    texts: dict[str, bytes] = {}
    try:
        for place, folders, names in os.walk(folder, onerror=_refuse):
            visible = [name for name in sorted(folders) if name != RESOURCES and not name.startswith(".")]
            folders[:] = [name for name in visible if Path(place, name) not in without]
            for path in [Path(place, name) for name in sorted(names) if not name.startswith(".")]:  # left by editors
                if (path.suffix == ".mo" or path.name == "package.order") and path.is_file():
                    with contextlib.suppress(FileNotFoundError):  # the file was deleted meanwhile
                        texts[path.relative_to(top or folder).as_posix()] = read_unrecorded(path)
    except OSError as error:
        message = f"the package can't be read: {error.strerror or error}"
        hint = "check the permissions of file and folder"
        file = shown(Path(os.fsdecode(error.filename))) if error.filename else ""
        raise OutputError.of("unreadable", message, file, hint=hint) from error
    return texts


def _refuse(error: OSError) -> None:
    if not isinstance(error, FileNotFoundError | NotADirectoryError):
        raise error
