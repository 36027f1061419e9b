"""What git has made of a file that two branches wrote."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository

from urdfsync.engine import united
from urdfsync.engine.united import find_versions, join_sides

MERGE = "a\n<<<<<<< HEAD\nb\n=======\nc\n>>>>>>> theirs\nd\n"
DIFF3 = "a\n<<<<<<< HEAD\nb\n||||||| 1f0a\nx\n=======\nc\n>>>>>>> theirs\nd\n"


@pytest.mark.parametrize(
    ("text", "joined"),
    [
        (MERGE, "a\nb\nc\nd\n"),
        (DIFF3, "a\nb\nc\nd\n"),
        (MERGE.replace("\n", "\r\n"), "a\r\nb\r\nc\r\nd\r\n"),
        (f"{MERGE}{MERGE}".removesuffix("d\n"), "a\nb\nc\nd\na\nb\nc\n"),
        ("// =======\n=======\n", "// =======\n=======\n"),
        (MERGE.replace("=======\n", ""), MERGE.replace("=======\n", "")),
    ],
)
def test_both_sides_of_markers_are_joined(text: str, joined: str) -> None:
    assert join_sides(text) == joined


@pytest.mark.parametrize(
    ("text", "is_lacking", "is_by_lines"),
    [
        ("a\nb\nc\nd\n", False, True),
        ("a\nb\nd\n", False, True),
        (MERGE, False, True),
        ("a\nb\nc\nd\nmine\n", False, False),
        ("b\nc\nd\n", True, False),
        ("a\nc\nd\n", True, True),
        (MERGE.replace("\nb", "\nmine"), False, False),
        (MERGE.replace("a\n", ""), False, False),
    ],
)
def test_what_a_merge_lacks_and_adds(text: str, is_lacking: bool, is_by_lines: bool) -> None:
    versions = ["a\nb\nd\n", "a\nc\nd\n"]
    assert united.lacks(text, versions, "a\nb\nC\nd\ne\n") is is_lacking
    assert united.is_merge_by_lines(text, versions) is is_by_lines


def test_classes_are_compared_by_their_elements() -> None:
    def model(*lines: str) -> str:
        return "\n".join(["model M", *lines, "end M;\n"])

    shared, ours, theirs = "  Real x;", "  Real y;", '  Real z "theirs";'
    versions = [model(shared, ours), model(shared, theirs)]
    assert not united.lacks(model(shared, ours, "  Real z;"), versions, model(shared, ours, theirs))
    assert united.lacks(model(shared, ours), versions, model(shared, theirs)), "which the merged source still has"
    assert not united.lacks(model(shared, ours), versions, model(shared)), "which nobody wants any more"
    assert united.lacks(model(ours, theirs), versions, model()), "which both have"


@NEEDS_GIT
def test_versions_of_a_merge(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "models/a.mo"
    assert find_versions(file) == [], "no repository"
    repository = Repository(tmp_path, monkeypatch)
    assert find_versions(file) == [], "no commit"
    file.parent.mkdir()

    def commit(text: str) -> None:
        file.write_text(text)
        repository.commit()

    commit("base\n")
    for branch in ("theirs", "ours"):
        repository.git("checkout", "-q", "-b", branch, "main")
        commit(f"{branch}\n")
    assert find_versions(file) == [], "no merge"
    subprocess.run(["git", "merge", "-q", "theirs"], cwd=tmp_path, capture_output=True)
    assert find_versions(file) == ["ours\n", "theirs\n"], "one that is under way"
    repository.commit()
    assert find_versions(file) == ["ours\n", "theirs\n"], "the last commit"
    assert find_versions(file.with_name("other.mo")) == []
    repository.commit()
    assert find_versions(file) == [], "an older one"
