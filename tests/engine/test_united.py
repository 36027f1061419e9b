"""What git has made of a file that two branches wrote."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository

from urdfsync.engine.united import find_versions, is_merge_by_lines, join_sides

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
    ("text", "is_gits"),
    [
        ("a\nb\nc\nd\n", True),
        ("a\nb\nd\n", True),
        (MERGE, True),
        ("a\nb\nc\nd\nmine\n", False),
        ("b\nc\nd\n", False),
        (MERGE.replace("b", "mine"), False),
    ],
)
def test_a_merge_by_lines_adds_nothing_and_lacks_nothing_that_is_shared(text: str, is_gits: bool) -> None:
    assert is_merge_by_lines(text, ["a\nb\nd\n", "a\nc\nd\n"]) is is_gits


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
