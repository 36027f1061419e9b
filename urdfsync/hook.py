"""`urdfsync-hook`: `urdfsync hook` for runners of git hooks. It ends soon, without a word, if nothing is to be done."""

from __future__ import annotations

import os
import sys

from urdfsync import uptodate
from urdfsync.hooks.answers import answer_key, find_configurations

_TRACKED = (b"H 100644 ", b"H 100755 ", b"H 120000 ")
"""How the entry of a file begins that the working tree has as it is staged; other modes are submodules."""


def main() -> int:
    """Run the hook with the arguments of the program; returns the exit code."""
    arguments = sys.argv[1:]
    try:
        if arguments in (["build"], ["check"]) and is_answered():
            return 0
        from urdfsync import cli  # four times the time of all the rest

        return cli.main(["hook", *arguments])
    except KeyboardInterrupt:
        return 130


def is_answered() -> bool:
    """Return whether the working tree has what is staged, and saved answers say that such a commit passes."""
    from urdfsync import git  # here, so that Ctrl-C during the import leaves no traceback

    try:
        listing, top = git.run(".", *git.LIST_INDEX), git.run(".", *git.TOP)
        if listing.returncode or top.returncode:
            return False
        files, folder = set(), os.fsdecode(top.stdout.removesuffix(b"\n"))
        for entry in listing.stdout.split(b"\0")[:-1]:
            head, _, path = entry.partition(b"\t")
            if not head.startswith(_TRACKED) or not head.endswith(b" 0"):
                return False  # it differs, or is not merged
            files.add(os.fsdecode(path))
        configurations, lost_states = find_configurations(files)
        if lost_states or not configurations:
            return False
        for file in (f"{folder}/{path}" for path in configurations):
            answer = uptodate.find_answer(file, answer_key(folder, file))
            if answer is None or not files.issuperset(answer):
                return False
    except Exception:  # noqa: BLE001 - whatever it is: the command meets it again, and reports it
        return False
    return True
