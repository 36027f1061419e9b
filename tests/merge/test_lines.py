"""The merge of whole lines is that of git; line ends are no difference."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often

from urdfsync.merge import merge
from urdfsync.merge.lines import merge_whole_lines, split_lines

Texts = tuple[list[str], list[str], list[str]]


@st.composite
def three_texts(draw: st.DrawFn) -> Texts:
    """Lines of few kinds, and twice the same lines with some of them replaced, gone or more."""
    line = st.sampled_from([f"{number}\n" for number in range(draw(st.sampled_from([2, 5, 40])))])
    base = draw(st.lists(line, max_size=30))
    sides = list(base), list(base)
    for side in sides:
        for _ in range(draw(st.integers(0, 5))):
            place, size = draw(st.integers(0, len(side))), draw(st.integers(0, 3))
            side[place : place + size] = draw(st.lists(line, max_size=3))
        if side and draw(st.integers(0, 9)) == 9:
            side[-1] = side[-1].removesuffix("\n")
    return base, *sides


def git_merge(folder: Path, texts: Texts) -> str | None:
    """What git makes of it, None for a conflict."""
    paths = [folder / name for name in ("base", "mine", "generated")]
    for path, text in zip(paths, texts, strict=True):
        path.write_bytes("".join(text).encode())
    base, mine, generated = map(str, paths)
    command = ["git", "-c", "merge.conflictStyle=merge", "merge-file", "-p", "-q", mine, base, generated]
    process = subprocess.run(command, capture_output=True, check=False)
    assert 0 <= process.returncode < 128, process.stderr
    return process.stdout.decode() if process.returncode == 0 else None


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed: there is nothing to compare with")
@often(100)
@given(texts=three_texts())
def test_lines_merge_as_in_git(texts: Texts, tmp_path: Path) -> None:
    expected = git_merge(tmp_path, texts)
    assert merge_whole_lines(*map("".join, texts)) == expected
    assert merge(*map("".join, texts)).text == expected


def test_only_line_feeds_end_a_line() -> None:
    assert split_lines("ä\u2028\x0b\r\nb\rc\n\nd") == ["ä\u2028\x0b\r\n", "b\rc\n", "\n", "d"]


def test_lines_keep_their_ends() -> None:
    assert merge_whole_lines("a\nb\nc\n", "a\r\nb\nc\n", "a\nb\nd\n") == "a\r\nb\nd\n"
