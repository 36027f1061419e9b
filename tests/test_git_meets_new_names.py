"""Git brings edits across an export that gives names to other parts: each edit follows its part, or is asked about.

CAD numbers its links: an inserted or removed one shifts the names behind it. Meanwhile a branch or a stash has edits of
some parts, which a build may have seen. `URDFSYNC_CASES=500` tries so many with fresh seeds.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.urdfs import robot_of

pytestmark = [NEEDS_GIT, pytest.mark.slow]

PACKAGE = Path("modelica/Arm")
PARTS = ("1.1", "2.2", "3.3", "4.4")
"""The masses of links, which tell the parts."""
NEW = "7.7"
Names = Mapping[str, str]
"""Names of links by parts."""


class Edit(NamedTuple):
    """An edit of a part's file."""

    part: str
    kind: str
    tag: str

    def make(self, names: Names) -> None:
        """Write the edit."""
        path = self.file(names)
        old, new = {
            "Links/{}": ("\nequation\n", f"\n  Real {self.tag} = 1;\n\nequation\n"),
            "Joints/{}": ("\nequation\n", f"\n  Real {self.tag} = 1;\n\nequation\n"),
            "Links/{}Parameters": (f"mass = {self.part},", f"mass = {self.tag},"),
        }[self.kind]
        text = path.read_text()
        assert text.count(old) == 1, path
        path.write_text(text.replace(old, new))

    def file(self, names: Names) -> Path:
        """The file of its part."""
        name = names[self.part].capitalize()
        return PACKAGE / (self.kind.format(name.replace("Link", "Joint") if "Joint" in self.kind else name) + ".mo")


TOLD = ("orphan", "unknown")
"""Reasons of files that no build generates, with an edit whose part's file has another one: `status` names them."""
KINDS = ("Links/{}", "Joints/{}", "Links/{}Parameters")


def numbered(*parts: str) -> dict[str, str]:
    return {part: f"link_{number}" for number, part in enumerate(parts, 1)}


def insert(random: Random) -> Names:
    place = random.randrange(3)
    return numbered(*PARTS[:place], NEW, *PARTS[place:])


def remove(random: Random) -> Names:
    gone = random.randrange(3)
    return numbered(*PARTS[:gone], *PARTS[gone + 1 :])


def exchange(random: Random) -> Names:
    one, other = random.sample(PARTS, 2)
    names = numbered(*PARTS)
    return names | {one: names[other], other: names[one]}


def rotate(random: Random) -> Names:
    return {part: f"link_{number % 4 + 1}" for number, part in enumerate(PARTS, 1)}


def shift(random: Random) -> Names:
    return {part: f"link_{number + 1}" for number, part in enumerate(PARTS, 1)}


EXPORTS: tuple[Callable[[Random], Names], ...] = (insert, remove, exchange, rotate, shift)
WAYS = (
    *("merge {theirs}", "merge {mine}", "rebase {mine}", "cherry-pick {theirs}"),
    *("stash", "apply", "apply --3way", "am --3way", "checkout {theirs} --"),
)
UNRECORDED = "stash", "apply", "apply --3way", "checkout {theirs} --"
"""Ways that leave no commit of the edit behind, or only one of another branch."""


def export(names: Names) -> None:
    """Write a chain of the parts; its order is that of the parts, not of their names."""
    Path("arm.urdf").write_text(
        robot_of(", ".join(f"{name.removeprefix('link_')} {part}" for part, name in names.items()))
    )


def edits_of(random: Random, start: int) -> list[Edit]:
    places = random.sample([(part, kind) for part in PARTS for kind in KINDS], random.randint(1, 4))
    return [
        Edit(part, kind, f"{part}{number:03d}" if "Parameters" in kind else f"tag{number:03d}")
        for number, (part, kind) in enumerate(places, start)
    ]


@often(60)
@given(seed=st.integers(0, 2**32))
def test_edits_follow_their_parts_or_are_asked_about(
    seed: int, tmp_path_factory: pytest.TempPathFactory, execute: Execute
) -> None:
    random = Random(seed)
    with pytest.MonkeyPatch.context() as monkeypatch:
        folder = tmp_path_factory.mktemp("project")
        monkeypatch.chdir(folder)
        repository = Repository(folder, monkeypatch)
        merging = random.choice(["", 'on_conflict = "merge"\n'])
        Path("urdfsync.toml").write_text(f'[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n{merging}')
        old, new = numbered(*PARTS), random.choice(EXPORTS)(random)
        export(old)
        if has_driver := random.random() < 0.4:
            execute("merge-driver", "--install")
        execute("build")
        repository.commit()
        theirs, ours, way = edits_of(random, 1), edits_of(random, 51), random.choice(WAYS)
        ours = [] if random.random() < 0.5 else ours
        are_seen = random.random() < 0.7 or way in UNRECORDED
        # theirs: edits of the robot as it was
        repository.git("checkout", "-q", "-b", "theirs")
        for edit in theirs:
            edit.make(old)
        if are_seen:
            execute("build")
        repository.git("stash", "-q") if way == "stash" else repository.commit()
        # mine: other edits, and the export
        repository.git("checkout", "-q", "main")
        for edit in ours:
            edit.make(old)
        if ours:
            execute("build")
        export(new)
        code = execute("build", code=None).code
        repository.commit()
        if code != 0:
            return  # the export alone asks already
        free = [edit for edit in theirs if edit.file(old) not in {one.file(new) for one in ours if one.part in new}]
        if way.startswith("checkout"):
            theirs = free  # git replaces the whole file
        if not bring(repository, way, [edit.file(old) for edit in theirs]):
            return
        settings = f"{way}, {new}, driver {has_driver}, seen {are_seen}, {theirs}, {ours}"
        look(execute, [*theirs, *ours], new, settings)
        repository.git("add", "-A")
        look(execute, [*theirs, *ours], new, f"added: {settings}")


def bring(repository: Repository, way: str, files: list[Path]) -> bool:
    """Bring the edits of the other branch; return whether git does so."""

    def is_done(*words: str | Path) -> bool:
        """Whether git does it, or leaves files unmerged."""
        code = subprocess.run(["git", *words], cwd=repository.folder, capture_output=True, check=False).returncode
        return code == 0 or repository.git("ls-files", "--unmerged") != ""

    command, *options = way.format(theirs="theirs", mine="main").split()
    if command == "stash":
        return is_done("stash", "pop", "-q")
    if command in ("apply", "am"):
        patch = repository.folder.with_suffix(".patch")
        patch.write_text(repository.git("format-patch", "--stdout", "-1", "theirs"))
        return is_done(command, *options, patch)
    if command == "checkout":
        return bool(files) and is_done(command, *options, *files)
    if options == ["main"]:
        repository.git("checkout", "-q", "theirs")
    return is_done(command, *options, *(["--no-edit"] if command == "merge" else []))


def look(execute: Execute, edits: list[Edit], names: Names, settings: str) -> None:
    """Build, and find each edit in the file of its part, in a conflict, or in a file that is told."""
    printed = execute("build", "--format=json", code=None)
    if printed.code == 2:
        assert "merge-markers" in printed.out, (settings, printed.out)
    found = {path: path.read_text() for path in sorted(PACKAGE.rglob("*.mo"))}
    (result,) = printed.json["results"]
    told = [one for one in result["actions"] if one["kind"] == "conflict" or one["is_waiting"] or one["reason"] in TOLD]
    open_ = {Path(path) for one in told for path in (one["path"], one["origin"] or one["path"])}
    for edit in edits:
        places = [path for path, text in found.items() if edit.tag in text]
        assert places, (f"{edit} is lost", settings, printed.words)
        if printed.code == 2 or edit.part not in names:
            continue
        wrong = [path for path in places if path != edit.file(names) and path not in open_]
        assert not wrong, (f"{edit} is in {wrong}", settings, printed.words)
