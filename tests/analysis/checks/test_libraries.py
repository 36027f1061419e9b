"""Modelica libraries in made-up folders: where they are found, which ones a package needs, and what is copied."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.libraries import (
    copy_named,
    find_library,
    find_standard_library,
    needed_libraries,
)
from urdfsync.common.diagnostics import UrdfsyncError

PACKAGE = 'package %s\n  annotation (\n    uses(Complex(version="9.9")),\n    version="%s");\nend %s;\n'


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home with nothing in it, and no libraries of the system."""
    for name in ("MODELICAPATH", "OPENMODELICALIBRARY", "OPENMODELICAHOME", "APPDATA", "PROGRAMFILES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("USERPROFILE", str(tmp_path / "home"))
    exists = Path.iterdir
    monkeypatch.setattr(Path, "iterdir", lambda self: iter(()) if "omlibrary" in self.parts[:5] else exists(self))
    return tmp_path / "home"


def put(folder: Path, *names: str) -> Path:
    """Libraries such as `Modelica 4.1.0` and `Complex.mo` in a folder; without a number in the name they are 4.1.0."""
    for name in names:
        first, _, version = name.removesuffix(".mo").partition(" ")
        file = folder / name if name.endswith(".mo") else folder / name / "package.mo"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(PACKAGE % (first, version or "4.1.0", first))
    return folder


def whole(folder: Path, version: str) -> Path:
    return put(folder, f"Modelica {version}", f"ModelicaServices {version}", f"Complex {version}.mo")


def code(configured: Path | None = None) -> str:
    with pytest.raises(UrdfsyncError) as caught:
        find_standard_library(configured)
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.hint
    return diagnostic.code


# --- where they are ---------------------------------------------------------------------------------------------------


def test_modelicapath_comes_first_then_openmodelicas_folders(
    tmp_path: Path, home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mine = whole(tmp_path / "mine", "4.1.0")
    others = whole(home / ".openmodelica" / "libraries", "4.2.0")
    assert find_standard_library()["Modelica"] == others / "Modelica 4.2.0"
    monkeypatch.setenv("MODELICAPATH", os.pathsep.join([str(tmp_path / "absent"), str(mine)]))
    assert find_standard_library()["Modelica"] == mine / "Modelica 4.1.0"


def test_libraries_of_programs_for_windows_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PROGRAMFILES", str(tmp_path / "Program Files [64]"))
    dymola = whole(tmp_path / "Program Files [64]" / "Dymola 2025x" / "Modelica" / "Library", "4.1.0")
    whole(tmp_path / "Program Files [64]" / "Dymola 2023" / "Modelica" / "Library", "4.2.0")
    assert find_standard_library()["Modelica"] == dymola / "Modelica 4.1.0"
    mine = whole(tmp_path / "AppData" / ".openmodelica" / "libraries", "4.1.0")
    monkeypatch.setenv("APPDATA", str(tmp_path / "AppData"))
    assert find_standard_library()["Modelica"] == mine / "Modelica 4.1.0"


def test_the_newest_version_below_5_is_taken_by_number(tmp_path: Path) -> None:
    for version in ("4.9.0", "4.10.0", "5.0.0"):
        whole(tmp_path, version)
    found = find_standard_library(tmp_path)
    assert found["Modelica"].name == "Modelica 4.10.0"
    assert {path.stem.partition(" ")[2].partition(".")[0] for path in found.values()} == {"4"}


def test_parts_of_the_same_generation_belong_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder without a version in its name tells it in its text; a later generation is the last resort."""
    assert find_standard_library(whole(tmp_path / "late", "5.0.0"))["Modelica"].name == "Modelica 5.0.0"
    bare = put(tmp_path / "bare" / ".openmodelica" / "libraries", "Modelica", "ModelicaServices", "Complex.mo")
    monkeypatch.setenv("APPDATA", str(tmp_path / "bare"))
    assert find_standard_library()["Modelica"] == bare / "Modelica"
    put(whole(tmp_path, "4.1.0"), "Modelica 4.2.0", "Modelica 5.0.0")
    found = find_standard_library(tmp_path)
    assert (found["Modelica"].name, found["Complex"].name) == ("Modelica 4.2.0", "Complex 4.1.0.mo")


def test_why_there_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert code() == "no-standard-library"
    monkeypatch.setenv("MODELICAPATH", str(put(tmp_path / "lone", "Modelica 4.1.0")))
    assert code() == "no-standard-library"
    old = whole(tmp_path / "old", "4.0.0+maint.om")
    monkeypatch.setenv("MODELICAPATH", str(old))
    assert code() == "standard-library-too-old"
    monkeypatch.setenv("MODELICAPATH", str(whole(tmp_path / "new", "4.1.0")))
    assert code(old) == "wrong-library-folder"
    assert code(tmp_path / "absent") == "wrong-library-folder"


def test_an_older_one_does_not_hide_one_that_suits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    old, new = (whole(tmp_path / name, name) for name in ("4.0.0", "4.1.0"))
    monkeypatch.setenv("MODELICAPATH", os.pathsep.join(map(str, (old, new))))
    assert find_standard_library()["Modelica"].parent == new


@pytest.mark.parametrize("name", ["Pumps", "Pumps 1.2.0", "Pumps.mo", "Pumps 1.2.mo"])
def test_other_libraries_are_found_by_name(name: str, tmp_path: Path) -> None:
    put(tmp_path / "second", name)
    put(tmp_path / "third", "Pumps 9.0.0")
    (tmp_path / "first" / "Pumps").mkdir(parents=True)  # no package
    places = [tmp_path / "absent", tmp_path / "first", tmp_path / "second", tmp_path / "third"]
    assert find_library("Pumps", places) == tmp_path / "second" / name
    assert find_library("Pump", places) is None


# --- which ones a package needs ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "names"), [
    ("Pumps.Small p; extends Tanks . Round;", {"Pumps", "Tanks"}),
    (".Pumps.Small p;", {"Pumps"}),
    ("import Pumps; import T = Tanks; import Valves.*;", {"Pumps", "Tanks", "Valves"}),
    ("arm.Pumps.x; a[1].Tanks.c; Real Pumps; MyPumps.A a;", set()),
    ('parameter String s = "Pumps.Small"; // Pumps.Small\n/* import Pumps; */', set()),
    ("Arm.Pumps.Small p; Modelica.Blocks.A a;", set()),
])  # fmt: skip
def test_libraries_are_what_names_begin_with(text: str, names: set[str], tmp_path: Path) -> None:
    place = put(tmp_path, "Pumps 1.2.0", "Tanks.mo", "Valves", "Arm", "Modelica 4.1.0")
    assert needed_libraries([text.encode()], "Arm", [place], ()).keys() == names


# --- the classes that are named ---------------------------------------------------------------------------------------

CLASSES = {
    "package": "package Modelica end Modelica;",
    "Mechanics/package": "package Mechanics end Mechanics;",
    "Mechanics/Body": "model Body extends Icons.Part; end Body;",
    "Icons": "package Icons partial model Part end Part; partial model Other end Other; end Icons;",
    "Fluid/package": "package Fluid end Fluid;",
    "Fluid/Tank": "model Tank end Tank;",
    "Pair/package": "operator record Pair end Pair;",
    "Pair/constructor": "operator constructor end constructor;",
    "Pair/'+'": "operator '+' end '+';",
}


@pytest.fixture
def small(tmp_path: Path) -> Mapping[str, Path]:
    """A made-up library."""
    folder = whole(tmp_path / "libraries", "4.1.0")
    for name, text in CLASSES.items():
        file = folder / "Modelica 4.1.0" / f"{name}.mo"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    (folder / "Modelica 4.1.0" / "Resources").mkdir()
    (folder / "Modelica 4.1.0" / "Resources" / "Large.mo").write_text("model Large end Large;")
    return find_standard_library(folder)


@pytest.fixture
def cache(tmp_path: Path) -> UserCache:
    return UserCache(tmp_path / "cache")


@pytest.mark.parametrize(("text", "files"), [
    ("", "package"),
    ("Modelica.Mechanics.Body b;", "package Mechanics/package Mechanics/Body Icons"),
    ("Modelica . Fluid.Tank t;", "package Fluid/package Fluid/Tank"),
    ("import Modelica.Fluid.*; Tank t; Large large;", "package Fluid/package Fluid/Tank"),
    ('Real Fluid "Modelica.Tank"; // Tank', "package Fluid/package"),
    ('"not closed: Fluid', "package"),
    # Modelica calls operators, and constructors, without their names
    ("Pair p;", "package Pair/package Pair/constructor Pair/'+'"),
])  # fmt: skip
def test_files_are_copied_whose_classes_are_named_and_those_that_they_need(
    text: str, files: str, small: Mapping[str, Path], cache: UserCache
) -> None:
    copied = copy_named(small, [text.encode()], cache)
    assert {path.name for path in copied.iterdir()} == {"Complex.mo", "Modelica", "ModelicaServices"}
    copies = {path.relative_to(copied / "Modelica"): path.read_text() for path in (copied / "Modelica").rglob("*.mo")}
    assert copies == {Path(f"{name}.mo"): CLASSES[name] for name in files.split()}


def test_a_copy_is_made_once_for_each_state(small: Mapping[str, Path], cache: UserCache) -> None:
    first = copy_named(small, (), cache)
    (first / "mark").touch()
    os.utime(first, (0, 0))
    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(lambda _: copy_named(small, (), cache), range(8))) == {first}
    assert (first / "mark").exists()
    assert first.stat().st_mtime > 0, "its last use is noted"
    (small["Modelica"] / "package.mo").write_text("package Modelica constant Real x = 1; end Modelica;")
    assert copy_named(small, (), cache) != first


def test_a_folder_that_can_not_be_read_is_named(
    small: Mapping[str, Path], cache: UserCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: Any) -> Any:
        if str(path).endswith("Fluid"):
            raise PermissionError(errno.EACCES, "Permission denied", path)
        return genuine(path)

    genuine = os.scandir
    monkeypatch.setattr(os, "scandir", refuse)
    with pytest.raises(UrdfsyncError, match=r"Fluid: error: the package can't be read: Permission denied"):
        copy_named(small, (), cache)


def test_a_standard_library_with_a_link_out_of_it_is_refused(
    small: Mapping[str, Path], cache: UserCache, tmp_path: Path
) -> None:
    (small["Modelica"] / "Mechanics/Loop").symlink_to(tmp_path, target_is_directory=True)
    with pytest.raises(UrdfsyncError, match="the link leads out of its library"):
        copy_named(small, (), cache)
    assert not list(cache.libraries.glob("*/Modelica"))
