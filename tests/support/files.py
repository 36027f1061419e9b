"""The files below a folder, and a test that they stay unchanged."""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterator
from pathlib import Path

from urdfsync import api
from urdfsync.modelica.stamp import split


def snapshot(folder: Path) -> dict[str, tuple[int, bytes]]:
    """Time of change and content of every file below a folder, except files of this machine: notes, records and
    the hook's clone.
    """
    files = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*")) if path.is_file()}
    left_out = ".urdfsync/notes/", ".urdfsync/deps/", ".git/urdfsync/"
    files = {name: path for name, path in files.items() if not name.startswith(left_out)}
    return {name: (path.stat().st_mtime_ns, path.read_bytes()) for name, path in files.items()}


def delete(path: Path) -> None:
    """Delete a file or folder; Windows deletes no read-only files, as those of git are."""
    for each in (path, *path.rglob("*")):
        each.chmod(0o700)
    shutil.rmtree(path) if path.is_dir() else path.unlink()


@contextlib.contextmanager
def unchanged(folder: Path, but: str = "") -> Iterator[None]:
    """Assert that the block writes no file below a folder, except one."""
    before = {**snapshot(folder), but: None}
    yield
    after = {**snapshot(folder), but: None}
    assert after == before, [name for name in after.keys() | before.keys() if after.get(name) != before.get(name)]


def outputs() -> list[Path]:
    """All files and folders of the working folder, without what is remembered of dependencies."""
    return sorted(path for path in Path().rglob("*") if "deps" not in path.parts)


def models() -> dict[str, str]:
    """The bare texts of the models and records of all packages in the working folder, by path."""
    return {path.as_posix(): split(path.read_text())[0] for path in sorted(Path("modelica").rglob("*.mo"))}


def fresh_models(folder: Path) -> dict[str, str]:
    """Build only from the source, in a copy of the working folder, and return the models and records."""
    shutil.rmtree(folder, ignore_errors=True)
    left_out = shutil.ignore_patterns(".git", ".urdfsync", "modelica", folder.name)
    with contextlib.chdir(shutil.copytree(Path.cwd(), folder, ignore=left_out)):
        assert not any(result.failed for result in api.build())
        return models()
