"""Reading and writing the files of a package: hashes, refusal of links, and writes that are whole or not at all."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from urdfsync.diagnostics import Diagnostic, OutputError, Severity

TEMPORARY = ".urdfsync-tmp"
"""Suffix of the files that are written before they replace their targets."""


def digest(content: bytes) -> str:
    """SHA-256 (hex) of bytes as they are."""
    return hashlib.sha256(content).hexdigest()


def text_digest(content: bytes) -> str:
    r"""SHA-256 (hex) of a text file's bytes with `\r\n` and `\r` read as `\n`."""
    if b"\r" in content:
        content = content.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return hashlib.sha256(content).hexdigest()


def templates_digest(folders: Sequence[Path]) -> str:
    """SHA-256 (hex) over the templates in use, by name and content; an earlier folder hides names of a later one."""
    templates: dict[str, Path] = {}
    for folder in reversed(folders):
        templates |= {path.relative_to(folder).as_posix(): path for path in folder.rglob("*.jinja")}
    lines = [f"{name}\0{text_digest(path.read_bytes())}\n" for name, path in sorted(templates.items())]
    return digest("".join(lines).encode())


def refuse(code: str, path: Path, message: str, hint: str = "") -> OutputError:
    """The error for a target that can't be used."""
    return OutputError(Diagnostic(Severity.ERROR, code, message, str(path), hint=hint))


class Tree:
    """The files below `root`, which no path may leave, not even through a symbolic link."""

    def __init__(self, root: Path, shown: Callable[[Path], str] = str) -> None:
        self.root = root
        self._shown = shown
        self._checked: set[Path] = {root}

    def read(self, path: Path) -> bytes | None:
        """The content of a file below the root, None if there is none.

        Raises OutputError for a link, for anything else that is no regular file, and for what can't be read.
        """
        if not self.check_folder(path.parent):
            return None
        try:
            mode = os.lstat(path).st_mode
            if stat.S_ISREG(mode):
                return path.read_bytes()
        except (FileNotFoundError, NotADirectoryError):
            return None
        except OSError as error:
            raise self._refusal("output-unreadable", path, f"it can't be read: {error.strerror}") from None
        what = "a symbolic link" if stat.S_ISLNK(mode) else "a folder" if stat.S_ISDIR(mode) else "no regular file"
        raise self._refusal("output-in-the-way", path, f"{what} is where urdfsync would write a file", "move it away")

    def check_folder(self, folder: Path) -> bool:
        """Whether a folder below the root exists. Raises OutputError if it is a file, a link, or not below the root."""
        if folder in self._checked:
            return True
        if self.root not in folder.parents:
            raise self._refusal("outside", folder, f"the path leaves {self._shown(self.root)}")
        if not self.check_folder(folder.parent):
            return False
        try:
            mode = os.lstat(folder).st_mode
        except FileNotFoundError:
            return False
        if not stat.S_ISDIR(mode):
            what = "a symbolic link" if stat.S_ISLNK(mode) else "a file"
            raise self._refusal("output-in-the-way", folder, f"{what} is where a folder is needed", "move it away")
        self._checked.add(folder)
        return True

    def _refusal(self, code: str, path: Path, message: str, hint: str = "") -> OutputError:
        return OutputError(Diagnostic(Severity.ERROR, code, message, self._shown(path), hint=hint))


def commit(writes: Mapping[Path, bytes], deletes: Iterable[Path] = ()) -> None:
    """Write and delete files; each is replaced as a whole, and none before all are on disk under other names.

    Raises OutputError if that is not possible; before the first replacement, nothing has changed then.
    """
    staged: dict[Path, Path] = {}
    try:
        for target, content in writes.items():
            staged[target] = _stage(target, content)
        if staged:
            _sync(staged.values())
        for target, temporary in staged.items():
            temporary.replace(target)
        for target in deletes:
            target.unlink(missing_ok=True)
    except OSError as error:
        place = Path(str(error.filename2 or error.filename or "")) if error.filename else next(iter(writes), Path())
        name = place.with_name(place.name.removesuffix(TEMPORARY).removeprefix(".")) if place.name else place
        hint = "check its permissions and the space on the disk, then build again"
        raise refuse("output-not-writable", name, f"it can't be written: {error.strerror}", hint) from None
    finally:
        for temporary in staged.values():
            temporary.unlink(missing_ok=True)


def remove_empty(folders: Iterable[Path], stop: Path) -> None:
    """Remove these folders and those above them, as far as they are empty and below `stop`."""
    for folder in sorted(set(folders), key=lambda path: len(path.parts), reverse=True):
        current = folder
        while stop in current.parents:
            try:
                current.rmdir()
            except OSError:  # it is not empty, gone already, or not ours to remove: all fine
                break
            current = current.parent


def _stage(target: Path, content: bytes) -> Path:
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = target.with_name(f".{target.name}{TEMPORARY}")
    temporary.unlink(missing_ok=True)
    try:
        with temporary.open("xb") as file:
            file.write(content)
        with contextlib.suppress(FileNotFoundError):
            temporary.chmod(stat.S_IMODE(target.stat().st_mode))
    except OSError:
        temporary.unlink(missing_ok=True)
        raise
    return temporary


def _sync(paths: Iterable[Path]) -> None:
    """Bring everything written so far to the disk: one call for all, since one per file takes 1.5 ms each."""
    if hasattr(os, "sync"):
        os.sync()
        return
    for path in paths:
        with path.open("rb+") as file:
            os.fsync(file.fileno())
