"""`urdfsync merge-driver`: git merges with it by elements, once it is installed in a clone."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository, make_repository_of_files

BASE = """\
model Arm "An arm"
  Body body(m = 11.5);

equation
  connect(frame_a, body.frame_a);
end Arm;
"""
MINE = BASE.replace("\nequation", "  Sensor sensor;\n\nequation").replace("An arm", "My arm")
OTHER = BASE.replace("\nequation", "  Body tool;\n\nequation").replace("11.5", "12.1")
BOTH = MINE.replace("\nequation", "  Body tool;\n\nequation").replace("11.5", "12.1")
ATTRIBUTES = "*.mo merge=urdfsync\n"
STAND_IN = pytest.mark.posix("git runs the driver, and the stand-in for git has a shell of another system")


def write(mine: str, base: str, other: str) -> tuple[str, str, str]:
    """Three files in git's order; git's have no suffix either."""
    for name, text in (("mine", mine), ("base", base), ("other", other)):
        Path(name).write_text(text)
    return "base", "mine", "other"


def test_both_sides_add_at_one_place(folder: Path, execute: Execute) -> None:
    assert execute("merge-driver", *write(MINE, BASE, OTHER)).lines == []
    assert (folder / "mine").read_text() == BOTH


def conflict(labels: tuple[str, str], size: int = 7) -> str:
    """Both texts merged, but for a mass that both have changed."""
    block = f"{'<' * size} {labels[0]}\n  Body body(m = 99);\n{'=' * size}\n  Body body(m = 12.1);\n"
    return BOTH.replace("  Body body(m = 12.1);\n", f"{block}{'>' * size} {labels[1]}\n")


def test_what_both_changed_stands_between_markers(folder: Path, execute: Execute) -> None:
    (folder / "mine").touch(mode=0o640)
    options = ("--ours=HEAD", "--theirs=-x\nbranch", "--marker-size=9", "--path=Arm.mo")
    assert execute("merge-driver", *options, *write(MINE.replace("11.5", "99"), BASE, OTHER), code=1).err == (
        "Arm.mo: warning: 1 conflict between markers; settle them in the file [conflict]\n"
    )
    assert (folder / "mine").read_text() == conflict(("HEAD", "-x branch"), 9)
    assert (folder / "mine").stat().st_mode & 0o777 == (0o640 if os.name == "posix" else 0o666)


def test_any_text_merges_by_lines(folder: Path, execute: Execute) -> None:
    execute("merge-driver", *write("a\nb\nmine\n", "a\nb\nc\n", "other\nb\nc\n"))
    assert (folder / "mine").read_text() == "other\nb\nmine\n"


def test_elements_that_do_not_fit_together_merge_by_lines(folder: Path, execute: Execute) -> None:
    """A declaration that is there twice is for people, as after any merge of git's."""
    mine, other = BASE.replace("  Body", "  Real x;\n  Body"), BASE.replace("\nequation", "  Real x, y;\n\nequation")
    execute("merge-driver", *write(mine, BASE, other))
    assert (folder / "mine").read_text() == mine.replace("\nequation", "  Real x, y;\n\nequation")


def test_what_is_not_utf_8_is_a_conflict_and_stays(folder: Path, execute: Execute) -> None:
    """So that git goes on with the other files."""
    write(MINE, BASE, OTHER)
    (folder / "other").write_bytes(b"\xff")
    error = execute("merge-driver", "base", "mine", "other", "--path", "Arm.mo", code=1).err
    assert error.startswith("Arm.mo: warning: the file is not UTF-8, so it can't be merged; ")
    assert (folder / "mine").read_text() == MINE


def test_errors_have_the_exit_code_that_git_knows(folder: Path, execute: Execute) -> None:
    write(MINE, BASE, OTHER)
    assert execute("merge-driver", "nowhere", "mine", "other", code=255).err.startswith("nowhere: error: ")
    for arguments, code in ((["base", "mine"], 255), ([], 255), (["--install", "base", "mine", "other"], 2)):
        assert "either --install or BASE MINE OTHER is needed" in execute("merge-driver", *arguments, code=code).err
    assert (folder / "mine").read_text() == MINE


@pytest.mark.parametrize("size", ["0", "-3"])
def test_markers_are_never_without_length(size: str, folder: Path, execute: Execute) -> None:
    """As in git, which takes seven then."""
    execute("merge-driver", f"--marker-size={size}", *write(MINE.replace("11.5", "99"), BASE, OTHER), code=1)
    assert (folder / "mine").read_text() == conflict(("ours", "theirs"))


# In a clone


@pytest.fixture
def clone(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """A clone with the branches `base`, `export` and `edited`, which is checked out; the driver is installed."""
    repository = Repository(folder, monkeypatch)
    (folder / ".gitattributes").write_text(ATTRIBUTES)
    for branch, text in (("base", BASE), ("export", OTHER), ("edited", MINE)):
        repository.git("checkout", "-q", "-b", branch, *(["base"] if text == MINE else []))
        (folder / "Arm.mo").write_text(text)
        repository.commit(branch)
    printed = execute("merge-driver", "--install")
    assert printed.out == f"git merges with urdfsync in {folder}\n"
    assert printed.err == ""
    assert (folder / ".gitattributes").read_text() == ATTRIBUTES
    return repository


@STAND_IN
@NEEDS_GIT
@pytest.mark.parametrize("command", ["merge -q", "rebase -q", "cherry-pick"])
def test_git_merges_with_it(clone: Repository, command: str) -> None:
    clone.git(*command.split(), "export")
    text = (clone.folder / "Arm.mo").read_text()
    assert sorted(text.splitlines()) == sorted(BOTH.splitlines())
    assert clone.git("status", "--porcelain") == ""


@STAND_IN
@NEEDS_GIT
def test_git_says_what_it_could_not_merge(clone: Repository) -> None:
    (clone.folder / "Arm.mo").write_text(MINE.replace("11.5", "99"))
    clone.commit()
    with pytest.raises(subprocess.CalledProcessError):
        clone.git("merge", "export")
    text = (clone.folder / "Arm.mo").read_text()
    assert text in (conflict(("ours", "theirs")), conflict(("HEAD", "export")))
    assert clone.git("diff", "--name-only", "--diff-filter=U") == "Arm.mo\n"


@NEEDS_GIT
@pytest.mark.parametrize("before", [None, b"", b"*.png binary", b"*.png binary\n"])
def test_the_line_that_is_missing_is_written(clone: Repository, execute: Execute, before: bytes | None) -> None:
    file = clone.folder / ".gitattributes"
    clone.git("rm", "-q", file.name)
    if before is not None:
        file.write_bytes(before)
    assert execute("merge-driver", "--install").lines[1] == ".gitattributes written: commit it"
    assert file.read_text() == ("*.png binary\n" if before and before.strip() else "") + ATTRIBUTES
    assert clone.git("check-attr", "merge", "--", "models/any.mo").endswith(": urdfsync\n")


@NEEDS_GIT
def test_attributes_that_cannot_be_written_are_told(clone: Repository, execute: Execute) -> None:
    (clone.folder / ".gitattributes").unlink()
    (clone.folder / ".gitattributes").mkdir()
    printed = execute("merge-driver", "--install", code=2)
    assert ".gitattributes: error: `*.mo merge=urdfsync` can't be added: " in printed.err


@STAND_IN
@NEEDS_GIT
def test_nothing_in_the_clone_is_run(clone: Repository) -> None:
    """Git starts the driver in its top folder, where Python would look for modules first."""
    evil = "from pathlib import Path\nPath('pwned').touch()\n"
    for name in ("urdfsync/__init__.py", "urdfsync/__main__.py", "argparse.py", "sitecustomize.py"):
        (clone.folder / name).parent.mkdir(exist_ok=True)
        (clone.folder / name).write_text(evil)
    clone.commit()
    clone.git("merge", "-q", "export")
    assert (clone.folder / "Arm.mo").read_text() == BOTH
    assert not (clone.folder / "pwned").exists()


@NEEDS_GIT
def test_without_a_clone_nothing_is_installed(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that poses as a bare repository is none."""
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(folder.parent))
    make_repository_of_files(folder)
    settings = (folder / "config").read_text()
    assert "; run it in a clone [git]" in execute("merge-driver", "--install", code=2).err
    assert (folder / "config").read_text() == settings


@NEEDS_GIT
def test_signs_that_git_would_replace_stay(
    clone: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", "/my python/100%Python")
    execute("merge-driver", "--install")
    assert "\ntry '/my python/100%%Python' -P -m urdfsync\n" in clone.git("config", "merge.urdfsync.driver")


@pytest.mark.windows
@NEEDS_GIT
def test_the_shell_of_git_gets_no_backslash(
    clone: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", r"C:\my python\python.exe")
    execute("merge-driver", "--install")
    assert "\ntry 'C:/my python/python.exe' -P -m urdfsync\n" in clone.git("config", "merge.urdfsync.driver")


# The environment has moved since


@pytest.fixture
def moved(
    clone: Repository, execute: Execute, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> Repository:
    """The clone; the recorded Python is gone, and no other program is on PATH."""
    with monkeypatch.context() as change:
        change.setattr(sys, "executable", "/moved/bin/python")
        execute("merge-driver", "--install")
    folder = tmp_path_factory.mktemp("bin")
    for name in ("git", "sh", "grep"):
        (folder / name).symlink_to(shutil.which(name) or name)
    monkeypatch.setenv("PATH", str(folder))
    return clone


def write_program(text: str) -> None:
    """Put a program of the name `urdfsync` on PATH."""
    file = Path(os.environ["PATH"], "urdfsync")
    file.write_text(f"#!/bin/sh\n{text}\n")
    file.chmod(0o755)


@NEEDS_GIT
def test_the_driver_is_found_by_its_name(moved: Repository) -> None:
    write_program(f'exec "{sys.executable}" -P -m urdfsync "$@"')
    moved.git("merge", "-q", "export")
    assert sorted((moved.folder / "Arm.mo").read_text().splitlines()) == sorted(BOTH.splitlines())


@NEEDS_GIT
@pytest.mark.parametrize(
    "program", [None, "exit 1", "exit 127", "kill -9 $$"], ids=["missing", "broken", "gone", "killed"]
)
def test_without_a_driver_git_merges_by_lines(moved: Repository, program: str | None) -> None:
    """A program that can't merge leaves both sides between git's markers, never one side alone."""
    if program:
        write_program(program)
    (moved.folder / "Arm.mo").write_text(MINE.replace("11.5", "99"))
    moved.commit()
    with pytest.raises(subprocess.CalledProcessError):
        moved.git("merge", "export")
    text = (moved.folder / "Arm.mo").read_text()
    assert text.count("<<<<<<<") == 1
    assert "m = 99" in text
    assert "m = 12.1" in text
    assert moved.git("diff", "--name-only", "--diff-filter=U") == "Arm.mo\n"


@NEEDS_GIT
def test_without_a_driver_changes_that_fit_still_merge(moved: Repository) -> None:
    (moved.folder / "Arm.mo").write_text(BASE.replace("connect(frame_a", "connect(frame_b"))
    moved.commit()
    moved.git("merge", "-q", "export")
    assert (moved.folder / "Arm.mo").read_text() == OTHER.replace("connect(frame_a", "connect(frame_b")


@NEEDS_GIT
def test_no_program_of_the_clone_is_the_driver(moved: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    """PATH may have the working folder."""
    monkeypatch.setenv("PATH", f".:{os.environ['PATH']}")
    (moved.folder / "urdfsync").write_text("#!/bin/sh\ntouch pwned\n")
    (moved.folder / "urdfsync").chmod(0o755)
    moved.commit()
    with pytest.raises(subprocess.CalledProcessError):
        moved.git("merge", "export")
    assert not (moved.folder / "pwned").exists()
