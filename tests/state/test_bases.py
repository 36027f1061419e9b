"""The bases: every text that was generated last is at hand, whatever git or a user does with its line."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import LADDER, MANIFEST, R1, RECORD, configure, edit, own_model, resistor, run, source

from urdfsync.dependencies import LSTAT, Dependencies
from urdfsync.engine.actions import Reason
from urdfsync.files import text_digest
from urdfsync.state import bases, file_operations
from urdfsync.state.record import Choice

BASES = Path(".urdfsync/bases/ladder")
NOTE = "  // mine\nend R1"


def stored(folder: Path = BASES) -> dict[str, str]:
    """All texts in the bases of a robot, by their hashes."""
    return {sha256: text for file in folder.iterdir() for sha256, text in bases.loads(file.read_bytes()).items()}


def mentioned() -> set[str]:
    """The hashes of texts that the recorded state mentions."""
    lines = re.findall(r"(?m)^file (\w{64})  (?!Resources/)", Path(MANIFEST).read_text())
    return set(lines)


def file_of(path: str) -> Path:
    """The file of bases that has the text of a file as it is on disk."""
    return BASES / text_digest(Path(path).read_bytes())[0]


def test_a_file_of_bases_is_sorted_and_comes_back() -> None:
    texts = {text_digest(text.encode()): text for text in ("b\n", 'a "\\ \u2028\n', "")}
    content = bases.dumps(texts)
    assert bases.loads(content) == texts
    assert content.splitlines() == sorted(content.splitlines())


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
    texts = {text_digest(text): text.decode() for text in (b"model A\nend A;\n", b"model B\nend B;\n")}
    lines = bases.dumps(texts).splitlines(keepends=True)
    assert bases.loads(b"".join(damage(lines))) == texts


@pytest.mark.parametrize("damage", [b"", b"0", b'x "', b"\xff", b'"', b"[" * 100_000, b'"\\ud800"'])
def test_a_line_whose_text_has_another_hash_is_none(damage: bytes) -> None:
    sha256 = text_digest(b"model A\nend A;\n").encode()
    good = bases.dumps({text_digest(b"B"): "B"})
    assert bases.loads(sha256 + b" " + damage + b"\n" + good) == {text_digest(b"B"): "B"}


def test_every_generated_text_has_its_line(project: Path) -> None:
    run()
    assert sorted(file.name for file in BASES.iterdir()) == [*bases.DIGITS]
    assert stored().keys() == mentioned()
    package = {path.read_text() for path in Path(LADDER).rglob("*.mo")}
    assert set(stored().values()) == package
    for file in BASES.iterdir():
        assert all(line.startswith(file.name) for line in file.read_text().splitlines())


def test_an_answer_depends_on_all_files_and_one_number_touches_two_at_most(project: Path) -> None:
    run()
    before = {file: file.stat().st_mtime_ns for file in BASES.iterdir()}
    with Dependencies() as found:
        assert run().in_step
    assert before.keys() <= {Path(path).relative_to(project) for check, path in found.entries if check == LSTAT}
    resistor(150)
    run()
    changed = [file for file in BASES.iterdir() if file.stat().st_mtime_ns != before[file]]
    assert changed == [file_of(RECORD)]
    assert mentioned() <= stored().keys()


def test_old_texts_go_with_later_builds_but_are_no_reason_for_one(project: Path) -> None:
    run()
    first = text_digest(Path(RECORD).read_bytes())
    resistor(150)
    run()
    assert first in stored(), "the state before it mentions it"
    assert run(full=True, dry=True).in_step
    for ohm in range(150, 153):
        resistor(ohm + 1, before=ohm)
        run()
        assert mentioned() <= stored().keys()
    assert first not in stored()
    assert len(stored()) == len(mentioned()) + 1


def test_while_something_is_open_no_text_goes(project: Path) -> None:
    run()
    resistor(150)
    run()
    before = stored().keys()
    edit(R1, "end R1", NOTE)
    source('"ohm": 150', '"farad": 1e-6')
    assert run(full=True).conflicts
    assert before <= stored().keys()


def test_a_lost_file_of_bases_is_written_anew(project: Path) -> None:
    run()
    before = {file.name: file.read_bytes() for file in BASES.iterdir()}
    for digit in "3a":
        (BASES / digit).unlink()
    run()
    assert {file.name: file.read_bytes() for file in BASES.iterdir()} == before


@pytest.mark.parametrize("damage", [lambda _: b"", lambda text: text.replace(b"record", b"records")])
def test_damaged_lines_are_out_of_step_and_mended(project: Path, damage: Callable[[bytes], bytes]) -> None:
    run()
    before = {file.name: file.read_bytes() for file in BASES.iterdir()}
    for file in BASES.iterdir():
        file.write_bytes(damage(file.read_bytes()))
    assert stored().keys() < mentioned()
    assert not run(dry=True).in_step
    run()
    assert {file.name: file.read_bytes() for file in BASES.iterdir()} == before


def test_bases_follow_the_name_of_their_robot_and_go_with_it(project: Path, execute: Execute) -> None:
    run()
    before = stored()
    edit("urdfsync.toml", "[robots.ladder]", "[robots.filter]")
    run()
    assert stored(Path(".urdfsync/bases/filter")) == before
    assert not BASES.exists()
    execute("remove", "filter", "--yes")
    assert not Path(".urdfsync/bases").exists()


def test_files_for_git_gain_lines_and_keep_those_of_the_user(project: Path) -> None:
    ignore, attributes = Path(".urdfsync/.gitignore"), Path(".urdfsync/.gitattributes")
    ignore.parent.mkdir()
    ignore.write_text("/*\n!/.gitignore\n!/robots/\n# mine\n!/notes.txt")
    attributes.write_text("/robots/*.state merge=union\nnotes.txt text\n")
    run()
    assert ignore.read_text() == "/*\n!/.gitignore\n!/robots/\n# mine\n!/notes.txt\n!/.gitattributes\n!/bases/\n"
    assert attributes.read_text().startswith("/robots/*.state merge=union\nnotes.txt text\n")
    assert "/bases/** merge=union -diff -text linguist-generated\n" in attributes.read_text()
    before = ignore.read_bytes(), attributes.read_bytes()
    resistor(150)
    run()
    assert (ignore.read_bytes(), attributes.read_bytes()) == before


def test_texts_are_stored_before_the_files_that_were_generated_with_them(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    order = []
    place = file_operations.place

    def noted(path: Path, target: Path) -> None:
        order.append(target.relative_to(project).as_posix())
        place(path, target)

    monkeypatch.setattr(file_operations, "place", noted)
    run()
    kinds = [next(one for one in ("bases", "robots", "modelica", "git") if one in path) for path in order]
    assert kinds.index("modelica") > max(i for i, kind in enumerate(kinds) if kind == "bases")
    assert kinds[-1] == "robots"


TEMPLATES = "  Real heat;"
"""What new templates declare in the model of each element."""


@pytest.mark.parametrize("is_clone", [False, True], ids=["original", "clone"])
def test_an_edit_new_templates_and_an_export_in_one_interval_are_merged(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_clone: bool
) -> None:
    run()
    if is_clone:
        left_out = shutil.ignore_patterns("conflicts", "replaced", "lock", "stamp-*")
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


def test_an_edit_that_lies_over_many_builds_has_its_base(project: Path) -> None:
    run()
    edit(RECORD, "end R1", NOTE)
    for count in range(20):
        source(f'"ohm": {220.5 + count:g}}}', f'"ohm": {221.5 + count:g}}}')
        run()
    resistor(150)
    (found,) = run().conflict_texts
    assert found.base is not None
    run(choices={RECORD: Choice.MERGE})
    assert "150" in Path(RECORD).read_text()


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
