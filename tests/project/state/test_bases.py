"""The bases as text, and what they are for: every text that was generated last is at hand, whatever git does."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository
from support.networks import BASES, LADDER, R1, RECORD, configure, edit, mentioned, own_model, resistor, run, stored

from urdfsync.common.dependencies.facts import PATH
from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.files import text_hash
from urdfsync.engine.actions import Reason
from urdfsync.engine.inspect.package_files import bare_hash
from urdfsync.modelica.stamp import split
from urdfsync.project.state import bases

NOTE = "  // mine\nend R1"


def file_of(path: str) -> Path:
    """The file of bases that has the text of a file as it is on disk."""
    return BASES / bare_hash(Path(path).read_bytes())[0]


def test_a_file_of_bases_is_sorted_and_comes_back() -> None:
    texts = {text_hash(text.encode()): text for text in ("b\n", 'a "\\ \u2028\n', "")}
    content = bases.dumps(texts)
    assert bases.loads(content) == texts
    assert content.splitlines() == sorted(content.splitlines())
    assert bases.dumps(dict(reversed(texts.items()))) == content


@pytest.mark.parametrize(
    "damage",
    {
        "twice": lambda lines: lines + lines,
        "in another order": lambda lines: lines[::-1],
        "windows": lambda lines: [line.replace(b"\n", b"\r\n") for line in lines],
        "markers": lambda lines: [b"<<<<<<< ours\n", *lines, b"=======\n", b">>>>>>> theirs\n"],
    }.values(),
)
def test_what_git_makes_of_lines_does_no_harm(damage: Callable[[list[bytes]], list[bytes]]) -> None:
    texts = {text_hash(text): text.decode() for text in (b"model A\nend A;\n", b"model B\nend B;\n")}
    lines = bases.dumps(texts).splitlines(keepends=True)
    assert bases.loads(b"".join(damage(lines))) == texts


@pytest.mark.parametrize("damage", [b"", b"0", b'x "', b"\xff", b'"', b"[" * 100_000, b'"\\ud800"'])
def test_a_line_whose_text_has_another_hash_is_none(damage: bytes) -> None:
    sha256 = text_hash(b"model A\nend A;\n").encode()
    good = bases.dumps({text_hash(b"B"): "B"})
    assert bases.loads(sha256 + b" " + damage + b"\n" + good) == {text_hash(b"B"): "B"}


def test_every_generated_text_has_its_line(project: Path) -> None:
    run()
    assert sorted(file.name for file in BASES.iterdir()) == [*bases.DIGITS]
    assert stored().keys() == mentioned()
    package = {split(path.read_text())[0] for path in Path(LADDER).rglob("*.mo")}
    assert set(stored().values()) == package
    for file in BASES.iterdir():
        assert all(line.startswith(file.name) for line in file.read_text().splitlines())


def test_an_answer_depends_on_all_files_and_one_number_touches_two_at_most(project: Path) -> None:
    run()
    before = {file: file.stat().st_mtime_ns for file in BASES.iterdir()}
    with Reads() as found:
        assert run().in_step
    assert before.keys() <= {Path(os.path.relpath(path, project)) for kind, path in found.entries if kind == PATH}
    resistor(150)
    run()
    changed = [file for file in BASES.iterdir() if file.stat().st_mtime_ns != before[file]]
    assert changed == [file_of(RECORD)]
    assert mentioned() <= stored().keys()


@pytest.mark.parametrize("damage", ["garbage", "0" * 16 + ' "text"', "<<<<<<< ours"])
def test_a_damaged_line_is_a_warning_until_a_build_writes_the_file_anew(project: Path, damage: str) -> None:
    run()
    file, before = file_of(RECORD), file_of(RECORD).read_text()
    file.write_text(f"{before}{damage}\n")
    line = before.count("\n") + 1
    for dry in (True, False):
        (warning,) = [found for found in run(dry=dry).diagnostics if found.code == "broken-state"]
        assert (warning.file, warning.line) == (str(file), line)
    assert file.read_text() == before
    assert not run().diagnostics


TEMPLATES = "  Real heat;"
"""What new templates declare in the model of each element."""


@pytest.mark.parametrize("is_clone", [False, True], ids=["original", "clone"])
def test_an_edit_new_templates_and_an_export_in_one_interval_are_merged(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_clone: bool
) -> None:
    run()
    if is_clone:
        left_out = shutil.ignore_patterns("conflicts", "replaced", "lock", "deps")
        monkeypatch.chdir(shutil.copytree(project, tmp_path / "clone", ignore=left_out))
    edit(R1, "end R1", NOTE)
    edit(RECORD, "end R1", NOTE)
    own_model(TEMPLATES)
    resistor(150)
    configure('on_conflict = "merge"\n')
    result = run()
    assert not result.conflicts
    assert {one.path for one in result.actions if one.reason is Reason.MERGE} == {R1, RECORD}
    assert TEMPLATES in Path(R1).read_text()
    assert "// mine" in Path(R1).read_text()
    assert "150" in Path(RECORD).read_text()
    assert "// mine" in Path(RECORD).read_text()


@NEEDS_GIT
@pytest.mark.parametrize("how", ["merge", "rebase", "cherry-pick"])
def test_git_unites_the_bases_of_two_branches(project: Path, monkeypatch: pytest.MonkeyPatch, how: str) -> None:
    edit("ladder.json", "},\n", "},\n\n")  # neighbours apart, as git wants them
    run()
    repository = Repository(project, monkeypatch)
    repository.commit()
    for branch, changes in {"theirs": {"220.5": "330", "1e-6": "2e-6"}, "ours": {"4.7e-6": "5e-6"}}.items():
        repository.git("checkout", "-q", "-b", branch, "main")
        for old, new in changes.items():
            edit("ladder.json", old, new)
            run()
        repository.commit()
    unite: Mapping[str, tuple[str, ...]] = {
        "merge": ("merge", "-q", "--no-edit", "theirs"),
        "rebase": ("rebase", "-q", "theirs"),
        "cherry-pick": ("cherry-pick", "theirs"),
    }
    repository.git(*unite[how])
    assert mentioned() <= stored().keys()
    assert repository.git("status", "--porcelain") == ""
    run()
    assert mentioned() <= stored().keys()
    for file in BASES.iterdir():
        assert bases.dumps(bases.loads(file.read_bytes())) == file.read_bytes()
