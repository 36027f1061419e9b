"""Modelica libraries in made-up folders."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.checking.libraries import library
from urdfsync.checking.libraries.library import LibraryError

PACKAGE = 'package %s\n  annotation (\n    uses(Complex(version="9.9")),\n    version="%s");\nend %s;\n'


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


def code(search: Callable[[], object]) -> str:
    with pytest.raises(LibraryError) as caught:
        search()
    (diagnostic,) = caught.value.diagnostics
    assert diagnostic.hint
    return diagnostic.code


def test_modelicapath_comes_first(tmp_path: Path) -> None:
    mine = whole(tmp_path / "mine", "4.1.0")
    whole(tmp_path / "home" / ".openmodelica" / "libraries", "4.2.0")
    environment = {"MODELICAPATH": os.pathsep.join([str(tmp_path / "absent"), str(mine)])}
    assert library.standard(environment, tmp_path / "home").modelica.path == mine / "Modelica 4.1.0"
    assert library.standard({}, tmp_path / "home").version == "4.2.0"


def test_openmodelica_keeps_libraries_below_its_own_folder(tmp_path: Path) -> None:
    place = whole(tmp_path / "om" / "lib" / "omlibrary", "4.1.0")
    found = library.standard({"OPENMODELICAHOME": str(tmp_path / "om")}, tmp_path)
    assert found.services.path == place / "ModelicaServices 4.1.0"


def test_and_on_windows_below_that_of_applications(tmp_path: Path) -> None:
    place = whole(tmp_path / ".openmodelica" / "libraries", "4.1.0")
    found = library.standard({"APPDATA": str(tmp_path)}, tmp_path / "home")
    assert found.complex.path == place / "Complex 4.1.0.mo"


def test_versions_are_numbers(tmp_path: Path) -> None:
    for version in ("4.9.0", "4.10.0", "4.1.0"):
        whole(tmp_path, version)
    found = library.standard({}, tmp_path, tmp_path)
    assert [one.version for one in (found.modelica, found.services, found.complex)] == [(4, 10, 0)] * 3


def test_a_folder_without_a_version_tells_it_in_its_text(tmp_path: Path) -> None:
    put(tmp_path, "Modelica", "ModelicaServices", "Complex.mo")
    assert library.standard({}, tmp_path, tmp_path).version == "4.1.0"


def test_a_version_that_lacks_a_part_does_not_count(tmp_path: Path) -> None:
    put(whole(tmp_path, "4.1.0"), "Modelica 4.2.0", "Modelica 5.0.0")
    for part in ("ModelicaServices 5.0.0", "Complex 5.0.0.mo"):
        put(tmp_path, part)
    found = library.standard({}, tmp_path, tmp_path)
    assert found.version == "4.2.0", "its parts may be of another 4.x"
    assert found.services.version == (4, 1, 0)


def test_a_later_generation_is_the_last_resort(tmp_path: Path) -> None:
    whole(tmp_path, "5.0.0")
    assert library.standard({}, tmp_path, tmp_path).version == "5.0.0"


def test_there_may_be_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.checking.libraries.library._OPENMODELICA", ())
    assert code(lambda: library.standard({}, tmp_path)) == "no-standard-library"
    put(tmp_path / "lone", "Modelica 4.1.0")
    assert code(lambda: library.standard({"MODELICAPATH": str(tmp_path / "lone")}, tmp_path)) == "no-standard-library"


@pytest.mark.parametrize("version", ["4.0.0", "3.2.3", "4.0.0+maint.om"])
def test_one_that_is_too_old_is_named(version: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.checking.libraries.library._OPENMODELICA", ())
    environment = {"MODELICAPATH": str(whole(tmp_path, version))}
    with pytest.raises(
        LibraryError, match=rf"is {version.partition('+')[0]}; the compiler takes 4\.1 and newer"
    ) as caught:
        library.standard(environment, tmp_path / "home")
    assert caught.value.diagnostics[0].code == "standard-library-too-old"


def test_an_older_one_does_not_hide_one_that_suits(tmp_path: Path) -> None:
    places = [str(whole(tmp_path / name, name)) for name in ("4.0.0", "4.1.0")]
    assert library.standard({"MODELICAPATH": os.pathsep.join(places)}, tmp_path).version == "4.1.0"


def test_the_folder_of_the_configuration_must_have_one(tmp_path: Path) -> None:
    whole(tmp_path / "home" / ".openmodelica" / "libraries", "4.1.0")
    assert code(lambda: library.standard({}, tmp_path / "home", tmp_path)) == "wrong-library-folder"
    old = whole(tmp_path / "old", "4.0.0")
    assert code(lambda: library.standard({}, tmp_path / "home", old)) == "wrong-library-folder"


def test_who_names_the_library_itself_is_told_the_folder_around_it(tmp_path: Path) -> None:
    whole(tmp_path, "4.1.0")
    with pytest.raises(LibraryError, match=f"name the folder around it: {tmp_path}"):
        library.standard({}, tmp_path, tmp_path / "Modelica 4.1.0")


@pytest.mark.parametrize("name", ["Pumps", "Pumps 1.2.0", "Pumps.mo", "Pumps 1.2.mo"])
def test_other_libraries_are_found_by_name(name: str, tmp_path: Path) -> None:
    put(tmp_path / "second", name)
    put(tmp_path / "third", "Pumps 9.0.0")
    (tmp_path / "first" / "Pumps").mkdir(parents=True)  # no package
    places = [tmp_path / "absent", tmp_path / "first", tmp_path / "second", tmp_path / "third"]
    assert library.find("Pumps", places) == tmp_path / "second" / name
    assert library.find("Pump", places) is None
    assert library.find("pumps", places) is None


def test_the_names_of_all_libraries_at_hand(tmp_path: Path) -> None:
    put(tmp_path / "one", "Pumps 1.2.0", "Pumps 1.3.0", "Tanks.mo")
    put(tmp_path / "two", "Valves")
    assert library.names([tmp_path / "one", tmp_path / "absent", tmp_path / "two"]) == {"Pumps", "Tanks", "Valves"}


@pytest.mark.parametrize("folders_only", [False, True])
def test_the_state_of_a_library_changes_with_its_files(folders_only: bool, tmp_path: Path) -> None:
    pumps = put(tmp_path, "Pumps") / "Pumps"
    (pumps / "Sub").mkdir()
    states = [library.state(pumps, folders_only=folders_only) for _ in range(2)]
    (pumps / "Sub" / "Small.mo").write_text("model Small end Small;")
    states.append(library.state(pumps, folders_only=folders_only))
    (pumps / "Sub" / "Small.mo").unlink()
    (pumps / "Sub" / "Large.mo").symlink_to("nowhere.mo")
    states.append(library.state(pumps, folders_only=folders_only))
    assert states[0] == states[1]
    assert len(set(states)) == 3


def test_the_state_of_a_file(tmp_path: Path) -> None:
    pumps = put(tmp_path, "Pumps.mo") / "Pumps.mo"
    before = library.state(pumps)
    pumps.write_text("package Pumps end Pumps;")
    assert library.state(pumps) != before


@given(st.lists(st.lists(st.integers(0, 30), min_size=1, max_size=4).map(tuple), min_size=1, max_size=6))
def test_the_newest_version_is_taken(versions: list[tuple[int, ...]]) -> None:
    names = [f"Pumps {library.dotted(version)}" for version in versions]
    newest = max(versions)
    assert max(names, key=lambda name: library.version(name)) == f"Pumps {library.dotted(newest)}"


def test_the_text_of_the_standard_library_tells_its_version(modelica_library: Path) -> None:
    found = library.standard({}, modelica_library, modelica_library)
    for one in (found.modelica, found.services, found.complex):
        assert library.written_version(one.text) == one.version
