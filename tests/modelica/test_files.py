"""Classes in files: whose they are, which of them use a name, and where words in them are replaced."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Any

import pytest

from urdfsync.modelica.classes import ClassNode
from urdfsync.modelica.files import (
    TooManyFoldersError,
    class_of_file,
    class_parts,
    class_path,
    files_that_use,
    modelica_files,
    place_of,
)
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.stored import StoredClasses
from urdfsync.modelica.unresolved import unresolved


def test_a_file_in_a_wrong_place_hides_no_class_of_its_name(tmp_path: Path) -> None:
    (tmp_path / "package.mo").write_text("package Shop\nend Shop;\n")
    (tmp_path / "Rotational.mo").write_text(
        "within Shop;\npackage Rotational\n model Gear\n end Gear;\nend Rotational;\n"
    )
    users = {
        Path("/nowhere/Part/package.mo"): b"package Part\nend Part;",
        Path("/nowhere/Part/Rotational.mo"): b"within Elsewhere;\nmodel Rotational\nend Rotational;",
        Path("/nowhere/Mine.mo"): b"model Mine\n Shop.Rotational.Gear gear;\nend Mine;",
    }
    sources = StoredClasses("None", Path("None"), {}, users, lambda name: tmp_path if name == "Shop" else None)
    assert sources.unread == [Path("/nowhere/Part/Rotational.mo")]
    scopes = Scopes(sources)
    mine = scopes.node(("Mine",))
    assert isinstance(mine, ClassNode)
    assert list(unresolved(mine, scopes)) == []


TEXTS = {
    "Arm/package.mo": b"package Arm\nend Arm;\n",
    "Cell.mo": b"model Cell\n Arm.Robot robot;\nend Cell;\n",
    "Hall.mo": b"model Hall\n Cell cell;\nend Hall;\n",
    "Words.mo": b'model Words "Arm"\n Arms a; // Arm\n /* Arm */\nend Words;\n',
    "Quoted.mo": b"model Quoted\n 'Arm // Robot' a; Arm.Robot r;\nend Quoted;\n",
    "Lib/package.mo": b"package Lib\n Hall hall;\nend Lib;\n",
    "User.mo": b"model User\n Lib.X x;\nend User;\n",
}


@pytest.mark.parametrize(("name", "users"), [
    ("Robot", ["Cell.mo", "Hall.mo", "Lib/package.mo", "Quoted.mo", "User.mo"]),
    ("Hall", ["Hall.mo", "Lib/package.mo", "User.mo"]),
    ("Arms", ["Words.mo"]),
    ("Arm // Robot", ["Quoted.mo"]),
    ("Nothing", []),
])  # fmt: skip
def test_files_that_use_a_name_or_a_file_that_does(name: str, users: list[str]) -> None:
    found = files_that_use({Path(path): text for path, text in TEXTS.items()}, [name])
    assert [path.as_posix() for path in found] == users


@pytest.mark.parametrize(("path", "name"), [
    ("package.mo", ()),
    ("Arm.mo", ("Arm",)),
    ("Joints/package.mo", ("Joints",)),
    ("Joints/Elbow.mo", ("Joints", "Elbow")),
])  # fmt: skip
def test_a_path_says_which_class_is_in_a_file(path: str, name: tuple[str, ...], tmp_path: Path) -> None:
    assert class_parts(path) == name
    assert class_path(PurePosixPath("Plant") / path).parts == ("Plant", *name)
    (tmp_path / "Plant").mkdir()
    (tmp_path / "Plant/package.mo").touch()
    around = {tmp_path / "Plant/Joints/package.mo": b""}
    assert place_of(tmp_path / "Plant" / path, around) == (tmp_path, ("Plant", *name)[:-1])
    assert class_of_file(tmp_path / "Plant" / path) == ("Plant", *name)[-1]


def test_files_below_a_folder_without_links_hidden_folders_and_resources(tmp_path: Path) -> None:
    for path in (
        "A.mo",
        "In/B.mo",
        "In/notes.txt",
        "Resources/C.mo",
        ".git/D.mo",
        "Other/mark",
        "Other/E.mo",
        "Out/F.mo",
    ):
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).touch()
    (tmp_path / "Link.mo").symlink_to("A.mo")
    (tmp_path / "Loop").symlink_to(tmp_path, target_is_directory=True)

    def found(*folders: Path, **options: Any) -> list[str]:
        return [Path(path).relative_to(tmp_path).as_posix() for path in modelica_files(*folders, **options)]

    assert found(tmp_path, others=["mark"], left_out=[str(tmp_path / "Out")]) == ["A.mo", "In/B.mo"]
    assert found(tmp_path / "Other", tmp_path / "In", tmp_path / "Other", others=["mark"]) == ["Other/E.mo", "In/B.mo"]
    assert len(found(tmp_path, most=4)) == 4
    with pytest.raises(TooManyFoldersError):
        found(tmp_path, most=3)


def test_where_a_class_is_looked_for(tmp_path: Path) -> None:
    """In the package as it is made, in files of the user and beside them, then in libraries."""
    beside, home = tmp_path / "beside", tmp_path / "library"
    for file in (home / "package.mo", home / "In/package.mo", home / "In/A.mo", beside / "Pumps/package.mo"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.touch()
    users = {beside / "Mine.mo": b'model Mine\n annotation (uses(Pipes(version="1")));\nend Mine;'}
    users[beside / "Other.mo"] = b"model Mine\nend Mine;"  # of two of one name the first counts
    folder, libraries = Path("/p/Arm"), {"Library": home, "Arm": home, "Old": home, "One": home / "One.mo"}
    package = b'package Arm\n annotation (uses(Wheels(version="1")));\nend Arm;'
    texts = {"package.mo": package, "Resources/R.mo": b"", "J.mo": b"within Arm;\nmodel J\nend J;"}
    classes = StoredClasses("Arm", folder, texts, users, libraries.get, former_package="Old")
    files = {
        "Arm": folder / "package.mo", "Arm.J": folder / "J.mo", "Arm.In.A": None, "Old.In": None,
        "Mine": beside / "Mine.mo", "Pumps": beside / "Pumps/package.mo", "Library": home / "package.mo",
        "Library.In.A": home / "In/A.mo", "Library.In.B": None, "One": home / "One.mo", "One.In": None, "Nowhere": None,
    }  # fmt: skip
    assert {name: classes.file(tuple(name.split("."))) for name in files} == {
        name: file and str(file) for name, file in files.items()
    }
    assert {*classes.names_in(("Library",))} == {"In"}
    assert {*classes.names_in(("Library", "In"))} == {"A"}
    assert {*classes.names_in(())} == {"Arm", "Mine"}
    assert [name for name in ("Modelica", "Pipes", "Wheels", "Cars") if classes.has_library(name)] == [
        "Modelica", "Pipes", "Wheels",
    ]  # fmt: skip
