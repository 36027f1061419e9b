"""Files as they are in another revision of a git repository. Reads the object database only, changes nothing."""

from __future__ import annotations

import itertools
import os
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, Severity, SourceError

_REFUSED = ("dubious ownership", "safe.directory")
"""What git says of a repository that belongs to somebody else."""


class Revision:
    """One revision of the repository that holds a folder."""

    def __init__(self, folder: Path, name: str) -> None:
        """Raises SourceError if git, the repository or the revision is missing."""
        self.name = name
        if name.startswith("-") or not name.strip() or not name.isprintable():
            raise _error("bad-revision", f"{name!r} is neither a file nor a git revision", hint=_NAMES)
        self._top = Path(os.path.realpath(_toplevel(folder, name)))
        found = self._git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
        self._commit = found.stdout.decode().strip()
        if found.returncode or not self._commit.isalnum():  # the commits that are none of another are `^HASH`
            message = f"{name!r} is neither a file nor a revision of the git repository {self._top}"
            raise _error("unknown-revision", message, hint=_NAMES)

    def label(self, file: Path) -> str:
        """How messages call a file of this revision."""
        return f"{self.name}:{shown(file)}"

    def read(self, file: Path) -> bytes:
        """The content of a file in this revision. Raises SourceError if it has none of this path."""
        content = self.contents([file]).get(file)
        if content is None:
            message = f"{shown(file)} does not exist in revision {self.name!r}"
            hint = "if it had another path then, save it with `git show REVISION:PATH > FILE`, and use --against FILE"
            raise _error("not-in-revision", message, self.label(file), hint)
        return content

    def holds(self, file: Path) -> bool:
        """Whether a file is where this repository keeps its files, in whatever revision; a submodule keeps its own."""
        place = Path(os.path.realpath(file))
        if self._top not in place.parents:
            return False
        inside = itertools.takewhile(lambda folder: folder != self._top, place.parents)
        return not any((folder / ".git").exists() for folder in inside)

    def contents(self, files: Sequence[Path]) -> Mapping[Path, bytes]:
        """The content of each of the files that this revision has."""
        named = {file: self._object(file) for file in files if self.holds(file)}
        asked = {file: name for file, name in named.items() if "\n" not in name}
        if not asked:
            return {}
        done = self._git("cat-file", "--batch", content="".join(f"{name}\n" for name in asked.values()).encode())
        if done.returncode:
            raise _failed(done)
        found: dict[Path, bytes] = {}
        rest = memoryview(done.stdout)
        for file, name in asked.items():
            # either `OBJECT missing`, or `HASH TYPE SIZE`, the content and a line feed
            missing = f"{name} missing\n".encode()
            if rest[: len(missing)] == missing:
                rest = rest[len(missing) :]
                continue
            head = bytes(rest[:256]).partition(b"\n")[0]
            _, kind, size = head.split(b" ")
            begin, end = len(head) + 1, len(head) + 1 + int(size)
            if kind == b"blob":
                found[file] = bytes(rest[begin:end])
            rest = rest[end + 1 :]
        return found

    def _object(self, file: Path) -> str:
        return f"{self._commit}:{Path(os.path.realpath(file)).relative_to(self._top).as_posix()}"

    def _git(self, *arguments: str, content: bytes = b"") -> subprocess.CompletedProcess[bytes]:
        return _run(self._top, *arguments, content=content)


_NAMES = "name an existing file, or a branch, tag or commit such as HEAD~1"


def _toplevel(folder: Path, name: str) -> str:
    done = _run(folder, "rev-parse", "--show-toplevel")
    if done.returncode == 0:
        return os.fsdecode(done.stdout).rstrip("\n")
    if any(word in os.fsdecode(done.stderr) for word in _REFUSED):
        raise _failed(done)
    message = f"there is no file {name!r}, and no git repository around {folder} that has it as a revision"
    raise _error("no-repository", message, hint=_NAMES)


def _run(folder: Path, *arguments: str, content: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    environment = {**os.environ, "LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0", "GIT_NO_REPLACE_OBJECTS": "1"}
    command = ["git", "-C", str(folder), *arguments]
    try:
        return subprocess.run(command, input=content, capture_output=True, env=environment, check=False)  # noqa: S603
    except FileNotFoundError:
        message, hint = "git is not installed, or not on PATH", "install it, or give --against a file"
        raise _error("no-git", message, hint=hint) from None
    except OSError as problem:
        raise _error("no-git", f"git can't be run: {problem.strerror}", hint="give --against a file") from None


def _failed(done: subprocess.CompletedProcess[bytes]) -> SourceError:
    said = done.stderr.decode(errors="replace").strip().partition("\n")[0].removeprefix("fatal: ")
    return _error("git", f"git failed: {said}", hint="put that right, or give --against a file")


def _error(code: str, message: str, file: str = "", hint: str = "") -> SourceError:
    return SourceError(Diagnostic(Severity.ERROR, code, message, file, hint=hint))
