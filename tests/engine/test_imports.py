"""Files that a source refers to: what is said of those that can't be had, and when nothing has to be done again."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec
import pytest

from urdfsync import registry
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Dependency
from urdfsync.engine import imports
from urdfsync.engine.imports import Imported, Recorded
from urdfsync.files import digest
from urdfsync.state.manifest import DependencyRecord
from urdfsync.state.modelfile import ConversionFacts

pytestmark = pytest.mark.usefixtures("rc_domain")

GOOD = b"0,0\n1,5\n"


def dependency(file: Path, uri: str = "step.csv") -> Dependency:
    return Dependency(uri, uri, (file,), "Resources/step.txt", "table", line=3)


def bring_in(*wanted: Dependency, before: Imported | None = None) -> Imported:
    """Import files, after a build that did `before`."""
    imported = before.imports.items() if before else ()
    copies = before.contents if before else {}
    recorded = Recorded(
        records=before.records if before else {},
        facts={key: ConversionFacts(i.source_hash, i.converter, dict(i.facts)) for key, i in imported},
        copy=copies.get,
        base=lambda target: digest(copies[target]) if target in copies else None,
    )
    domain = registry.domain("rcnetwork")
    return imports.bring_in(domain, wanted, recorded, "ladder.json", again=False, progress=lambda _done, _total: None)


def unchanged(wanted: Dependency, records: Mapping[str, DependencyRecord], converter: int = 1) -> bool:
    return imports.unchanged([wanted], records, converter)


def only(found: list[Diagnostic]) -> str:
    (diagnostic,) = found
    return str(diagnostic)


def test_a_file_that_cant_be_read_is_told_once(tmp_path: Path) -> None:
    file = tmp_path / "step.csv"
    file.write_text("no numbers\n")
    wanted = dependency(file)
    result = bring_in(wanted)
    assert [found.code for found in result.diagnostics] == ["table-unreadable"]
    assert unchanged(wanted, result.records)
    assert not unchanged(wanted, result.records, converter=2), "a newer converter may be able to read it"
    file.write_bytes(GOOD)
    assert not unchanged(wanted, result.records)
    assert bring_in(wanted, before=result).diagnostics == []


def test_a_file_that_cant_be_read_any_more_is_told_once(tmp_path: Path) -> None:
    file = tmp_path / "step.csv"
    file.write_bytes(GOOD)
    wanted = dependency(file)
    first = bring_in(wanted)
    file.write_text("no numbers\n")
    assert not unchanged(wanted, first.records)
    second = bring_in(wanted, before=first)
    assert [found.code for found in second.diagnostics] == ["table-unreadable-kept"]
    assert second.imports == first.imports
    assert unchanged(wanted, second.records)
    file.write_bytes(GOOD)
    assert unchanged(wanted, second.records), "the copy was made from these bytes"


def test_what_is_left_out_can_be_recalled(tmp_path: Path) -> None:
    missing, there = dependency(tmp_path / "gone.csv", "gone.csv"), dependency(tmp_path / "step.csv")
    records = {"gone.csv": DependencyRecord("gone.csv", "x"), "step.csv": DependencyRecord("step.csv", "y", "1f", "2f")}
    assert list(map(str, imports.reminder([missing, there], records, "ladder.json"))) == [
        "ladder.json: note: 1 table left out; `urdfsync build --full` says which, and why [left-out]"
    ]
    assert imports.reminder([there], records, "ladder.json") == ()


@pytest.mark.parametrize("uri", ["http://host/step.csv", "HTTPS://host/step.csv"])
def test_files_on_the_network_are_for_the_user_to_fetch(tmp_path: Path, uri: str) -> None:
    assert only(bring_in(dependency(tmp_path / "gone", uri)).diagnostics) == (
        f"ladder.json:3: warning: table `{uri}` is on the network, where urdfsync does not look; left out; "
        "download it, and let the source refer to the file [table-not-found]"
    )


@pytest.mark.parametrize(
    ("uri", "hint"),
    [
        ("package://ladder_data/step.csv", "add the folder that holds the folder `ladder_data` to `package_paths`"),
        ("modelica://Ladder.Data/step.csv", "put the folder that holds the library `Ladder` on MODELICAPATH"),
        ("tables/step.csv", "add the folder that holds it to `package_paths`"),
        ("/opt/tables/step.csv", "put it there, or let the source refer to it by a package or a relative path"),
        ("file:///opt/step.csv", "put it there, or let the source refer to it by a package or a relative path"),
        (r"D:\tables\step.csv", "put it there, or let the source refer to it by a package or a relative path"),
    ],
)
def test_what_to_do_about_a_file_that_is_not_found_goes_by_its_reference(tmp_path: Path, uri: str, hint: str) -> None:
    (found,) = bring_in(dependency(tmp_path / "gone", uri)).diagnostics
    assert (found.message, found.hint) == (f"table `{uri}` not found; left out", hint)


def test_what_is_found_in_a_folder_of_another_name_is_one_warning_for_each_package(tmp_path: Path) -> None:
    file = tmp_path / "step.csv"
    file.write_bytes(GOOD)
    uris = ["package://ladder_data/a.csv", "package://ladder_data/b.csv", "package://other/a.csv"]
    wanted = [msgspec.structs.replace(dependency(file, uri), guessed=True) for uri in uris]
    hint = "rename the folder, or add that of the right package to `package_paths`"
    folder = "taken from a folder that is not called like the package"
    assert list(map(str, bring_in(*wanted).diagnostics)) == [
        f"ladder.json:3: warning: 2 tables (such as `{uris[0]}`) are {folder} `ladder_data`; {hint} [table-guessed]",
        f"ladder.json:3: warning: table `{uris[2]}` is {folder} `other`; {hint} [table-guessed]",
    ]


def test_a_pointer_of_git_lfs_is_told_as_such(tmp_path: Path) -> None:
    file = tmp_path / "step.csv"
    file.write_bytes(b"version https://git-lfs.github.com/spec/v1\noid sha256:4d\nsize 12\n")
    assert only(bring_in(dependency(file)).diagnostics) == (
        "ladder.json:3: warning: table `step.csv` can't be read: it is a Git LFS pointer; left out; "
        "get the file itself with `git lfs pull` [table-unreadable]"
    )
