"""What is below a folder, and that it stays as it is."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path


def snapshot(folder: Path) -> dict[str, tuple[int, bytes]]:
    """Time of change and content of every file below a folder."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): (path.stat().st_mtime_ns, path.read_bytes()) for path in files}


@contextlib.contextmanager
def unchanged(folder: Path, but: str = "") -> Iterator[None]:
    """What happens within writes no file below a folder, but for one."""
    before = {**snapshot(folder), but: None}
    yield
    assert {**snapshot(folder), but: None} == before
