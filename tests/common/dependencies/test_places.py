"""A clone stands for a repository: whatever way a path takes, inside of the repository it leads into the clone."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from urdfsync.common.dependencies import reads
from urdfsync.common.dependencies.places import Clone, is_clone, named, place, real


@pytest.fixture
def clone(folder: Path) -> Clone:
    """A clone with other files than the repository, and a folder outside with a link into the repository."""
    root = Path(os.path.realpath(folder))
    for name in ("top", "clone"):
        (root / name / "v1").mkdir(parents=True)
        (root / name / "v1/file").write_text(name)
    (root / "clone/only").touch()
    (root / "top/mine").touch()
    (root / "clone/current").symlink_to("v1")
    (root / "clone/loop").symlink_to("loop")
    (root / "outside").mkdir()
    (root / "outside/file").write_text("outside")
    (root / "outside/back").symlink_to("../top/v1")
    return Clone(str(root / "top"), str(root / "clone"))


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("top/v1/file", "clone"),
        ("top/current/file", "clone"),
        ("outside/back/file", "clone"),
        ("outside/file", "outside"),
        ("top/v1/../../outside/file", "outside"),
        ("top/current/../v1/./file", "clone"),
    ],
)
def test_a_path_leads_into_the_clone(clone: Clone, path: str, text: str) -> None:
    with clone:
        assert reads.read_file(Path(clone.top).parent / path) == text.encode()


def test_what_only_the_working_tree_has_is_missing(clone: Clone) -> None:
    with clone:
        assert is_clone()
        assert reads.is_file(f"{clone.top}/only")
        for name in ("mine", "missing/../only", "v1/file/../../only", "loop"):
            assert not reads.is_file(f"{clone.top}/{name}"), name
    assert not is_clone()
    assert reads.is_file(f"{clone.top}/mine")


def test_an_error_names_the_file_of_the_repository(clone: Clone) -> None:
    with clone, pytest.raises(FileNotFoundError) as caught:
        reads.read_file(f"{clone.top}/mine")
    assert caught.value.filename == f"{clone.top}/mine"


def test_paths_are_told_as_in_the_repository(clone: Clone) -> None:
    with clone:
        assert real(f"{clone.top}/current/file") == f"{clone.top}/v1/file"
        assert named(place(f"{clone.top}/current/file")) == f"{clone.top}/current/file"
    outside = f"{Path(clone.top).parent}/outside"
    assert [clone.inside(f"{outside}/{name}") for name in ("back/file", "file")] == ["v1/file", None]


def test_a_path_with_thousands_of_folders_is_no_fault(clone: Clone) -> None:
    with clone:
        assert not reads.is_file(f"{clone.top}/{'a/' * 1900}b")
