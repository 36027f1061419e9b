"""What git has made of a file that two branches changed; `test_merges` has what becomes of it."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository

from urdfsync.engine.inspect.united import Sides, read_sides

pytestmark = NEEDS_GIT

BASE = "".join(f"{number}\n" for number in range(30))
OURS = BASE.replace("\n3\n", "\nour 3\n").replace("\n9\n", "\nour 9\n").replace("\n17\n", "\n17\nour 18\n")
THEIRS = BASE.replace("\n3\n", "\ntheir 3\n").replace("\n10\n", "\ntheir 10\n").replace("\n27\n", "\n")
SIDES = Sides(BASE, OURS, THEIRS)
FIRST = "<<<<<<< HEAD\nour 3\n=======\ntheir 3\n>>>>>>> theirs\n"
LEFT = f"""\
0
1
2
{FIRST}4
5
6
7
8
<<<<<<< HEAD
our 9
10
=======
9
their 10
>>>>>>> theirs
11
12
13
14
15
16
17
our 18
18
19
20
21
22
23
24
25
26
28
29
"""

Unite = Callable[..., Path]


@pytest.fixture
def unite(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Unite:
    """A function that lets git merge three texts of one file, with some of its settings."""

    def merge(ours: str = OURS, theirs: str = THEIRS, *settings: str, attributes: str = "", base: str = BASE) -> Path:
        repository, file = Repository(tmp_path, monkeypatch), tmp_path / "models/a.mo"
        file.parent.mkdir()
        (tmp_path / ".gitattributes").write_text(attributes)
        for branch, text in (("base", base), ("theirs", theirs), ("ours", ours)):
            repository.git("checkout", "-q", "-b", branch, *(["base"] if branch != "base" else []))
            file.write_bytes(text.encode())
            repository.commit()
        options = [word for setting in settings for word in ("-c", setting)]
        subprocess.run(["git", *options, "merge", "-q", "theirs"], cwd=tmp_path, capture_output=True)
        return file

    return merge


@pytest.mark.parametrize("style", ["merge", "diff3", "zdiff3"])
@pytest.mark.parametrize("attributes", ["", "*.mo conflict-marker-size=12", "*.mo text eol=crlf"])
def test_what_git_left_is_known_in_every_style(unite: Unite, style: str, attributes: str) -> None:
    file = unite(OURS, THEIRS, f"merge.conflictStyle={style}", attributes=attributes)
    text = file.read_bytes().decode()
    assert (text == LEFT) == (style == "merge" and not attributes)
    assert read_sides(file, text) == SIDES


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (FIRST, "our 3\n"),
        (FIRST, "their 3\n"),
        (FIRST, "our 3\ntheir 3\n"),
        (FIRST, "their 3\nour 3\n"),
        (FIRST, "3\n"),
        (FIRST, ""),
        ("our 3\n", "our 4\n"),
        ("their 3\n", "3\n"),
        ("our 18\n", ""),
        ("26\n28\n", "26\n27\n28\n"),
        ("<<<<<<< HEAD\nour 9", "our 9"),
        (">>>>>>> theirs\n11", "11"),
        ("21\n", "mine\n"),
        ("21\n", ""),
    ],
)
def test_what_somebody_has_begun_to_settle_is_his(unite: Unite, old: str, new: str) -> None:
    file = unite()
    assert read_sides(file, LEFT) == SIDES
    assert old in LEFT
    assert read_sides(file, LEFT.replace(old, new)) is None


def test_a_clean_merge_is_known_until_somebody_changes_it(unite: Unite) -> None:
    theirs = BASE.replace("\n27\n", "\n")
    file = unite(OURS, theirs)
    text = file.read_text()
    assert text == OURS.replace("\n27\n", "\n")
    assert read_sides(file, text) == Sides(BASE, OURS, theirs)
    assert read_sides(file, text.replace("our 9", "mine")) is None
    assert read_sides(file, text.replace("our 9", "9")) is None


def test_both_sides_of_a_conflict_are_a_merge(unite: Unite) -> None:
    ours, theirs = (BASE.replace("\n17\n", f"\n17\n{line}\n") for line in ("our line", "their line"))
    file = unite(ours, theirs)
    text = BASE.replace("\n17\n", "\n17\nour line\ntheir line\n")
    assert read_sides(file, text) == Sides(BASE, ours, theirs)
    assert read_sides(file, text.replace("their line\n", "")) is None


def test_a_file_that_both_added(unite: Unite) -> None:
    file = unite("a\nours\n", "a\ntheirs\n", base="")
    assert read_sides(file, file.read_text()) == Sides("", "a\nours\n", "a\ntheirs\n")


def test_sides_are_known_as_long_as_git_has_them(unite: Unite, tmp_path: Path) -> None:
    file = tmp_path / "models/a.mo"
    assert read_sides(file, LEFT) is None, "no repository"
    unite()
    assert read_sides(file.with_name("other.mo"), LEFT) is None
    git = ["git", "-c", "user.name=a", "-c", "user.email=b"]
    subprocess.run([*git, "add", "."], cwd=tmp_path, check=True)
    assert read_sides(file, LEFT) == SIDES, "as it was staged"
    subprocess.run([*git, "commit", "-qm", "merge"], cwd=tmp_path, check=True)
    assert read_sides(file, LEFT) == SIDES, "the last commit"
    subprocess.run([*git, "commit", "-qm", "next", "--allow-empty"], cwd=tmp_path, check=True)
    assert read_sides(file, LEFT) is None, "an older one"


@pytest.mark.parametrize("damage", ["index", "objects", "HEAD"])
def test_a_repository_that_is_damaged_tells_nothing(unite: Unite, tmp_path: Path, damage: str) -> None:
    file = unite()
    if damage == "objects":
        shutil.rmtree(tmp_path / ".git/objects")
    else:
        (tmp_path / ".git" / damage).write_bytes(b"DIRC\0\0")
    assert read_sides(file, file.read_text()) is None


def test_a_shallow_clone_of_a_merge_tells_nothing(unite: Unite, tmp_path: Path) -> None:
    unite(OURS, BASE.replace("\n27\n", "\n"))
    clone = tmp_path / "clone"
    subprocess.run(["git", "clone", "-q", "--depth=1", tmp_path.as_uri(), str(clone)], check=True)
    file = clone / "models/a.mo"
    assert read_sides(file, file.read_text()) is None
