"""Packages are read, libraries hashed and copied: regular files alone count, and none may fill disk or memory."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import Any

import pytest

from urdfsync.analysis.checks.contents import content_hash, copy_library, package_texts
from urdfsync.common.diagnostics import OutputError, UrdfsyncError
from urdfsync.common.files import shown


def make_library(folder: Path) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text("package Pumps\nend Pumps;\n")
    return folder


def refused(path: Path, target: Path) -> str:
    with pytest.raises(UrdfsyncError) as caught:
        copy_library(path, target)
    (found,) = caught.value.diagnostics
    assert found.code == "library-not-copied"
    return f"{found.file}: {found.message}; {found.hint}"


@pytest.mark.parametrize("link", ["all", "itself", "folder", "file", "device"])
def test_a_link_in_a_library_that_could_fill_the_disk_is_refused(link: str, tmp_path: Path) -> None:
    """By copies and by the hash of their content, which would read all that is behind it."""
    library = make_library(tmp_path / "Pumps")
    (library / "Resources").mkdir()
    (tmp_path / "outside.txt").write_text("a secret")
    outside = str(tmp_path / "outside.txt")
    targets = {
        "all": "/",
        "folder": str(library / "Resources"),
        "itself": str(library),
        "file": outside,
        "device": "/dev/zero",
    }
    (library / "Resources/link").symlink_to(targets[link])
    said = refused(library, tmp_path / "copy")
    assert said.startswith(f"{shown(library / 'Resources/link')}: the link leads ")
    assert said.endswith("; replace the link by the files themselves")
    assert not [path for path in (tmp_path / "copy").rglob("*") if path.is_file() and "link" in path.name]
    with pytest.raises(UrdfsyncError, match="the link leads "):
        content_hash(library)


def test_a_link_to_a_file_of_the_library_and_to_the_library_itself_are_followed(tmp_path: Path) -> None:
    make_library(tmp_path / "real/Pumps")
    (tmp_path / "real/Pumps/Small.mo").symlink_to("package.mo")
    (tmp_path / "Pumps").symlink_to("real/Pumps", target_is_directory=True)
    before = content_hash(tmp_path / "Pumps")
    copy_library(tmp_path / "Pumps", tmp_path / "copy")
    assert (tmp_path / "copy/Small.mo").read_text() == (tmp_path / "Pumps/package.mo").read_text()
    (tmp_path / "real/Pumps/package.mo").write_text("package Pumps end Pumps;")
    assert content_hash(tmp_path / "Pumps") != before


def test_a_library_that_is_too_large_is_refused_before_it_fills_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    library = make_library(tmp_path / "Pumps")
    with (library / "zeros.bin").open("wb") as file:
        file.truncate(2**40)  # takes nothing on the disk, as in a repository
    assert "Pumps: the library takes more than 512 MB" in refused(library, tmp_path / "copy")
    (library / "zeros.bin").unlink()
    monkeypatch.setattr("urdfsync.analysis.checks.contents.MOST_BYTES", 40_000)
    for number in range(20):
        (library / f"{number}.txt").touch()
    refused(library, tmp_path / "other")
    assert len(list((tmp_path / "other").iterdir())) < 10, "empty files take space as well"


@pytest.fixture
def odd(tmp_path: Path) -> Path:
    """A package with what is no regular file; but one link leads to such."""
    folder = tmp_path / "Odd"
    for path in (folder, tmp_path / "elsewhere"):
        path.mkdir()
        (path / "package.mo").write_bytes(b"package Odd")
    (tmp_path / "Real.mo").write_bytes(b"model")
    (folder / "Dangling.mo").symlink_to("nowhere.mo")
    (folder / "Circle.mo").symlink_to("Circle.mo")
    (folder / "Linked").symlink_to(tmp_path / "elsewhere")
    (folder / "images").symlink_to(tmp_path)
    (folder / "Real.mo").symlink_to(tmp_path / "Real.mo")
    if hasattr(os, "mkfifo"):
        os.mkfifo(folder / "Pipe.mo")
    return folder


def test_what_is_no_regular_file_is_left_out(odd: Path) -> None:
    assert package_texts(odd) == {"package.mo": b"package Odd", "Real.mo": b"model"}
    assert package_texts(odd / "absent") == {}


@pytest.fixture
def plant(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package, seen from the folder that it is in."""
    monkeypatch.chdir(tmp_path)
    for path in ("package.mo", "Control.mo", "Robots/package.mo", "Resources/Old.mo", ".git/Hidden.mo", ".#Control.mo"):
        (tmp_path / "Plant" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "Plant" / path).touch()
    return tmp_path / "Plant"


def test_hidden_files_resources_and_folders_that_are_named_are_left_out(plant: Path) -> None:
    assert package_texts(plant).keys() == {"package.mo", "Control.mo", "Robots/package.mo"}
    assert package_texts(plant, plant.parent, {plant / "Robots"}).keys() == {"Plant/package.mo", "Plant/Control.mo"}


@pytest.mark.parametrize("name", ["Plant/Control.mo", "Plant/Robots"])
def test_what_can_not_be_read_is_named_as_people_see_it(
    name: str, plant: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: str, *rest: Any) -> Any:
        if os.fspath(path).endswith(name):
            raise PermissionError(errno.EACCES, "Permission denied", path)
        return genuine(path, *rest)

    method = "open" if name.endswith(".mo") else "scandir"
    genuine = getattr(os, method)
    with monkeypatch.context() as patch:
        patch.setattr(os, method, refuse)
        with pytest.raises(OutputError) as caught:
            package_texts(plant)
    (found,) = caught.value.diagnostics
    assert (found.file, found.message) == (name, "the package can't be read: Permission denied")
    assert found.hint


def test_a_file_that_would_fill_the_memory_is_refused(plant: Path) -> None:
    with (plant / "Large.mo").open("wb") as file:
        file.truncate(2**40)  # takes nothing on the disk, as in a repository
    with pytest.raises(OutputError, match=r"Plant/Large\.mo: error: the package can't be read: it has more than"):
        package_texts(plant)


def test_the_hash_of_a_library_is_that_of_names_and_contents(tmp_path: Path) -> None:
    library = make_library(tmp_path / "Pumps")
    (library / "Resources").mkdir()
    first, whole = content_hash(library, ["Resources"]), content_hash(library)
    for path in (".hidden", "__pycache__", "Resources/data.txt"):
        (library / path).write_text("new")
    assert content_hash(library, ["Resources"]) == first
    assert content_hash(library) != whole
    (library / "package.mo").rename(library / "Package.mo")
    assert content_hash(library, ["Resources"]) != first
    assert content_hash(library / "Package.mo") != content_hash(library / ".hidden")
