"""What git lists of the index: how it is asked, and the answer if nothing differs, had without loading anything."""

import os

LISTING = ("ls-files", "-z", "-v", "--stage", "--modified", "--full-name", "--", ":/")
"""Compares contents where times differ, filters applied, and needs no lock for that."""
TOP = ("rev-parse", "--show-toplevel")

_PATHSPECS = {f"GIT_{kind}_PATHSPECS" for kind in ("LITERAL", "GLOB", "NOGLOB", "ICASE")}
_BLOCK = 1 << 20
_TRACKED = (b"H 100644 ", b"H 100755 ", b"H 120000 ")
"""How the entry of a file begins that the working tree has as it is staged; other modes are submodules."""


def environment() -> dict[str, str]:
    """The variables with which git is called: those of git's own caller, which may name another index."""
    variables = {name: value for name, value in os.environ.items() if name not in _PATHSPECS}
    return variables | {"LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0"}


def unchanged() -> tuple[str, set[str]] | None:
    """The top folder of the repository around the working folder, and its tracked files by their path from there.

    None if the working tree has another content of any of them, or if that is not easy to tell.
    """
    if not hasattr(os, "posix_spawnp"):
        return None
    variables = environment()
    listing, top = _start(LISTING, variables), _start(TOP, variables)
    entries, place = _finish(*listing), _finish(*top)
    if entries is None or place is None:
        return None
    files = set()
    for entry in entries.split(b"\0")[:-1]:
        head, _, path = entry.partition(b"\t")
        if not head.startswith(_TRACKED) or not head.endswith(b" 0"):
            return None
        files.add(os.fsdecode(path))
    return os.fsdecode(place.removesuffix(b"\n")), files


def _start(arguments: tuple[str, ...], variables: dict[str, str]) -> tuple[int, int]:
    """Start git; its process and what it writes to. Raises OSError if there is none."""
    source, sink = os.pipe()
    try:
        actions = [
            (os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0),
            (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0),
            (os.POSIX_SPAWN_DUP2, sink, 1),
        ]
        return os.posix_spawnp("git", ["git", *arguments], variables, file_actions=actions), source
    except BaseException:
        os.close(source)
        raise
    finally:
        os.close(sink)


def _finish(process: int, source: int) -> bytes | None:
    """All that a process writes; None if it fails."""
    said = []
    while block := os.read(source, _BLOCK):
        said.append(block)
    os.close(source)
    _, status = os.waitpid(process, 0)
    return b"".join(said) if status == 0 else None
