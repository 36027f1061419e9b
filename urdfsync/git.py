"""Calls of git, with which the hooks ask for the index."""

from __future__ import annotations

import os
import subprocess

TOP = ("rev-parse", "--show-toplevel")
LIST_INDEX = ("ls-files", "-z", "-v", "--stage", "--modified", "--full-name", "--", ":/")
"""Lists the index, and once more each file that is modified or deleted. Where times differ, git compares contents,
filters applied."""

_PATHSPECS = {f"GIT_{kind}_PATHSPECS" for kind in ("LITERAL", "GLOB", "NOGLOB", "ICASE")}


def run(folder: str | os.PathLike[str], *arguments: str, content: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    """Run git in a folder, with `content` as its standard input. Raises OSError if git can't be started.

    The variables of git's own caller count: GIT_DIR and GIT_INDEX_FILE name what is being committed.
    """
    variables = {name: value for name, value in os.environ.items() if name not in _PATHSPECS}  # they redefine `:/`
    variables |= {"LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"}  # English messages; git must not refresh the index
    command = ["git", "-C", os.fspath(folder), *arguments]
    return subprocess.run(command, input=content, capture_output=True, env=variables, check=False)  # noqa: S603


def reason(done: subprocess.CompletedProcess[bytes]) -> str:
    """Return git's own words for why it failed."""
    lines = os.fsdecode(done.stderr).strip().splitlines() or [f"exit code {done.returncode}"]
    return next((line for line in lines if line.startswith("fatal: ")), lines[-1]).removeprefix("fatal: ")
