"""The user's merge tool: git's, if one is configured there, else the editor of `$VISUAL` or `$EDITOR`."""

from __future__ import annotations

import itertools
import os
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from urdfsync.diagnostics import Diagnostic, Severity, UrdfsyncError

_SETTINGS = r"^(merge\.tool|mergetool\..*)$"

_REPOSITORY = ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_PREFIX", "GIT_OBJECT_DIRECTORY", "GIT_COMMON_DIR")


class Versions(NamedTuple):
    """The texts of one file, as bytes."""

    base: bytes
    mine: bytes
    generated: bytes
    proposal: bytes
    """What the tool begins with; what it saves there is the result."""


def edit(name: str, versions: Versions, root: Path) -> Path:
    """Let the user edit the proposal for a file called `name`; returns the saved file, in a folder of its own.

    `root` is where git looks for its settings. Raises UrdfsyncError if there is no tool, or if it fails.
    """
    git = _configured_git(root)
    command = os.environ.get("VISUAL") or os.environ.get("EDITOR") or ""
    if not git and not command:
        hint = "set $VISUAL, or git's `merge.tool`"
        raise UrdfsyncError(Diagnostic(Severity.ERROR, "no-editor", "there is no editor to open", hint=hint))
    folder = Path(tempfile.mkdtemp(prefix="urdfsync-edit-"))
    file, path = folder / name, PurePosixPath(name)
    file.write_bytes(versions.proposal)
    if git:
        code = _run_git(git, file, versions)
    else:
        others = []
        for side, content in zip(Versions._fields, versions[:3], strict=False):
            others.append(folder / f"{path.stem}.{side}{path.suffix}")
            others[-1].write_bytes(content)
        code = _run([*_words(command), str(file), *map(str, others)], folder)
    if code:
        message = f"the editor ended with exit code {code}; nothing was changed"
        raise UrdfsyncError(Diagnostic(Severity.ERROR, "editor-failed", message, hint=f"what it saved is in {folder}"))
    return file


def _words(command: str) -> list[str]:
    try:
        return shlex.split(command)
    except ValueError as error:
        message, hint = f"`{command}` is no command: {str(error).lower()}", "correct $VISUAL or $EDITOR"
        raise UrdfsyncError(Diagnostic(Severity.ERROR, "no-editor", message, hint=hint)) from None


def _run(command: Sequence[str], folder: Path) -> int:
    """Run a program on this terminal; its exit code. Raises UrdfsyncError if it can't be started."""
    try:
        return subprocess.run(command, cwd=folder, env=_environment(), check=False).returncode  # noqa: S603
    except OSError as error:
        message = f"`{command[0]}` can't be started: {error.strerror}"
        found = Diagnostic(Severity.ERROR, "no-editor", message, hint="set $VISUAL, or git's `merge.tool`")
        raise UrdfsyncError(found) from error


def _environment() -> dict[str, str]:
    """The environment without what makes git work in another repository, as it is set for hooks and aliases."""
    return {name: value for name, value in os.environ.items() if name not in _REPOSITORY}


def _configured_git(root: Path) -> list[str]:
    """The command of git with the settings of its merge tool; empty if no tool is set."""
    git = shutil.which("git")
    if git is None:
        return []
    command = [git, "-C", str(root), "config", "-z", "--get-regexp", _SETTINGS]
    listed = subprocess.run(command, capture_output=True, check=False).stdout.decode(errors="replace")  # noqa: S603
    found = dict(line.split("\n", 1) for line in listed.split("\0") if "\n" in line)
    settings = {**found, "mergetool.keepBackup": "false", "mergetool.prompt": "false"}
    pairs = (("-c", f"{name}={value}") for name, value in settings.items())
    return [git, *itertools.chain.from_iterable(pairs)] if found.get("merge.tool") else []


def _run_git(git: Sequence[str], file: Path, versions: Versions) -> int:
    """Run `git mergetool` on a file that is unmerged in a repository made for that."""

    def call(*arguments: str, given: bytes = b"") -> str:
        command = [*git, *arguments]
        return subprocess.run(  # noqa: S603
            command, cwd=file.parent, env=_environment(), input=given, capture_output=True, check=True
        ).stdout.decode()

    try:
        call("init", "--quiet")
        blobs = [call("hash-object", "-w", "--stdin", given=content).strip() for content in versions[:3]]
        stages = "".join(f"100644 {blob} {stage}\t{file.name}\0" for stage, blob in enumerate(blobs, 1))
        call("update-index", "-z", "--index-info", given=stages.encode())
    except subprocess.CalledProcessError as error:
        message = f"git can't prepare the merge: {error.stderr.decode(errors='replace').strip()}"
        raise UrdfsyncError(Diagnostic(Severity.ERROR, "editor-failed", message)) from error
    return _run([*git, "mergetool", "--", file.name], file.parent)
