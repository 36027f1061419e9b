"""Git's unfinished merges, where a text is no scenario: submodules, written indexes; see `scenarios/unmerged.txt`."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.urdfs import joint, link, robot

pytestmark = NEEDS_GIT

RECORD = Path("modelica/Arm/Links/UpperParameters.mo")
GONE = "/moved/bin/python -m urdfsync merge-driver %O %A %B"


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """An arm, built and committed; the merge driver is not found."""
    Path("arm.urdf").write_text(
        robot(
            link("base"),
            link("upper", 1, rpy="0 0 0"),
            joint("shoulder", "revolute", "base", "upper", axis="0 0 1"),
        )
    )
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\non_conflict = "merge"\n')
    repository = Repository(folder, monkeypatch)
    Path(".gitattributes").write_text("*.mo merge=urdfsync\n")
    repository.git("config", "merge.urdfsync.driver", GONE)
    execute("build")
    repository.commit()
    return repository


def branch(repository: Repository, execute: Execute, name: str, old: str, new: str, file: Path = RECORD) -> None:
    """Make a branch from main with one change, built."""
    repository.git("checkout", "-q", "-b", name, "main")
    edit(file, old, new)
    execute("build")
    repository.commit()


def merge(repository: Repository, command: str = "merge theirs") -> None:
    with pytest.raises(subprocess.CalledProcessError):
        repository.git(*command.split())
    assert "<<<<<<<" not in RECORD.read_text()


@pytest.fixture
def apart(repository: Repository, execute: Execute) -> Repository:
    """Their branch edits the mass, and ours exports another inertia."""
    branch(repository, execute, "theirs", "mass = 1", "mass = 4.5")
    branch(repository, execute, "ours", 'ixx="0.021"', 'ixx="0.025"', Path("arm.urdf"))
    return repository


@pytest.mark.parametrize("inside", [False, True])
def test_an_unmerged_submodule_or_a_file_in_it_is_not_in_step(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch, inside: bool
) -> None:
    cad = Repository(repository.folder / "cad", monkeypatch)
    for name, mass in (("theirs", 2), ("main", 3)):
        cad.git("checkout", "-q", "-B", name, *(["theirs~"] if name == "main" else []))
        cad.commit("before")
        shutil.copy("arm.urdf", "cad/arm.urdf")
        edit(Path("cad/arm.urdf"), '<mass value="1"/>', f'<mass value="{mass}"/>')
        cad.commit()
    edit(Path("urdfsync.toml"), "arm.urdf", "cad/arm.urdf")
    execute("build")
    repository.commit()
    execute("build", "--check")
    if inside:
        cad.merge("theirs")
        cad.git("merge", "--abort")
        with pytest.raises(subprocess.CalledProcessError):
            cad.git("merge", "theirs")
        shutil.copy("arm.urdf", "cad/arm.urdf")
        edit(Path("cad/arm.urdf"), '<mass value="1"/>', '<mass value="3"/>')
    else:
        commits = [cad.git("rev-parse", name).strip() for name in ("main~", "main", "theirs")]
        lines = "".join(f"160000 {commit} {stage}\tcad\n" for stage, commit in enumerate(commits, start=1))
        repository.git("update-index", "--force-remove", "cad")
        subprocess.run(["git", "update-index", "--index-info"], input=lines.encode(), check=True)
    assert "cad/arm.urdf: warning: git has not merged" in execute("build", "--check", "--verbose", code=1).err
    execute("status", code=1)


def test_a_saved_answer_ends_with_the_merge(apart: Repository, execute: Execute) -> None:
    """The text of our side stays, so that no file that a build reads changes but the index."""
    for _ in range(2):
        execute("status")
    index = apart.git("hash-object", "-w", str(RECORD)).strip()
    lines = "".join(f"100644 {index} {stage}\t{RECORD}\n" for stage in (1, 2, 3))
    subprocess.run(
        ["git", "update-index", "--index-info"], input=f"0 {'0' * 40}\t{RECORD}\n{lines}".encode(), check=True
    )
    execute("status", code=1)


@pytest.mark.parametrize("label", ["main", "elsewhere"])
def test_a_merge_of_two_other_files_is_no_version_of_a_file(
    repository: Repository, execute: Execute, label: str
) -> None:
    """If renames of both branches end at one path, the index may have git's merge there, with markers."""
    text = RECORD.read_text()
    merged = f"<<<<<<<< HEAD:Other.mo\nrecord Other\n========\n{text}>>>>>>>> {label}:{RECORD}\n"
    lines = f"0 {'0' * 40}\t{RECORD}\n"
    for stage, version in ((2, text), (3, merged)):
        Path("version").write_text(version)
        lines += f"100644 {repository.git('hash-object', '-w', 'version').strip()} {stage}\t{RECORD}\n"
    subprocess.run(["git", "update-index", "--index-info"], input=lines.encode(), check=True)
    execute("build")
    assert RECORD.read_text() == text
    repository.git("add", "-A")
    execute("build", "--check")


@pytest.mark.parametrize("style", ["merge", "diff3", "zdiff3"])
@pytest.mark.parametrize("attributes", ["", "*.mo conflict-marker-size=12", "*.mo text eol=crlf"])
def test_markers_of_every_style_and_size_are_read(
    repository: Repository, execute: Execute, style: str, attributes: str
) -> None:
    Path(".gitattributes").write_text(attributes)
    repository.commit()
    branch(repository, execute, "theirs", "mass = 1", "mass = 4.5")
    branch(repository, execute, "ours", "mass = 1", "mass = 4.5 + 0")
    edit(RECORD, "ixx = 0.021", "ixx = 0.025")
    repository.commit()
    repository.git("config", "merge.conflictStyle", style)
    with pytest.raises(subprocess.CalledProcessError):
        repository.git("merge", "theirs")
    assert "<<<<<<<" in RECORD.read_text()
    assert "both branches changed" in execute("build", code=3).words
    execute("resolve", str(RECORD), "--merge", "--prefer", "theirs")
    assert "mass = 4.5," in RECORD.read_text()
    assert "ixx = 0.025" in RECORD.read_text()


def test_markers_that_git_knows_no_more_are_an_error(repository: Repository, execute: Execute) -> None:
    """Without their common ancestor, nobody knows what both branches meant."""
    Path(".gitattributes").unlink()
    repository.commit()
    branch(repository, execute, "theirs", "mass = 1", "mass = 4.5")
    branch(repository, execute, "ours", "mass = 1", "mass = 5.5")
    with pytest.raises(subprocess.CalledProcessError):
        repository.git("merge", "theirs")
    before = RECORD.read_text()
    repository.git("add", "-A")
    assert "unresolved merge markers" in execute("build", code=2).words
    assert RECORD.read_text() == before
