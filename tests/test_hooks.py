"""The building hook, called by git and by the real pre-commit: real commits, stashes and roll-backs.

`commands/test_hook.py` tests the differences of the checking hook, without commits.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from support.daemon import Watch
from support.git import NEEDS_GIT, Repository
from support.networks import RC_FOLDER, RECORD, edit, resistor

from urdfsync.commands import cli

REPOSITORY = Path(__file__).parents[1]
PRE_COMMIT = Path(sys.executable).parent / "pre-commit"

pytestmark = [
    NEEDS_GIT,
    pytest.mark.slow,
    pytest.mark.skipif(not PRE_COMMIT.is_file(), reason="pre-commit is not installed"),
]


def commit(*arguments: str, code: int = 0) -> str:
    """Commit the staged files; return the output of the hooks."""
    done = subprocess.run(["git", "commit", "-m", "next", *arguments], check=False, capture_output=True, text=True)
    said = done.stdout + done.stderr
    assert done.returncode == code, said
    return said


def git(*arguments: str) -> str:
    return subprocess.run(["git", *arguments], check=True, capture_output=True, text=True).stdout


@pytest.fixture
def make(project: Path, rc_site: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """A function that makes a repository with a committed network in step, and installs the building hook."""
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(map(str, (REPOSITORY, rc_site, RC_FOLDER))))
    monkeypatch.setenv("PRE_COMMIT_HOME", str(project.parent / "store"))
    monkeypatch.setenv("PRE_COMMIT_ALLOW_NO_CONFIG", "1")
    repository = Repository(project, monkeypatch)
    script = f"{sys.executable} -P -m urdfsync hook"

    def make() -> None:
        cli.main(["build", "--quiet"])
        hook = f"id: urdfsync-build, name: build, entry: {script} build, language: system"
        options = "pass_filenames: false, always_run: true, stages: [pre-commit, pre-merge-commit]"
        Path(".pre-commit-config.yaml").write_text(
            f"default_install_hook_types: [pre-commit, pre-merge-commit]\n"
            f"repos:\n- repo: local\n  hooks:\n  - {{{hook}, {options}}}\n"
        )
        repository.commit()
        subprocess.run([PRE_COMMIT, "install"], check=True, capture_output=True)

    return make


def command(said: str) -> list[str]:
    """The command that a hook has printed."""
    (line,) = (line for line in said.splitlines() if "`git add " in line)
    return line.split("`")[3].split()


def test_a_stale_commit_fails_and_passes_on_the_second_try(make: Callable[[], None]) -> None:
    make()
    resistor(120)
    git("add", ".")
    said = commit(code=1)
    assert "robot `ladder`: the package was out of step, and has been built: 1 file written; run `git add " in said
    git(*command(said)[1:])
    commit()
    assert "120" in git("show", f"HEAD:{RECORD}")
    assert git("status", "--porcelain") == ""


def test_a_staged_source_with_later_changes(make: Callable[[], None]) -> None:
    """pre-commit stashes the later change, so the hook builds the staged one; then the later one comes back."""
    make()
    resistor(120)
    git("add", ".")
    resistor(130, before=120)
    said = commit(code=1)
    assert "robot `ladder`: the package was out of step, and has been built: 1 file written" in said
    assert '"ohm": 130}' in Path("ladder.json").read_text()
    git(*command(said)[1:])
    commit()
    assert "120" in git("show", f"HEAD:{RECORD}")
    assert git("status", "--porcelain") == " M ladder.json\n", "nothing is lost"
    assert cli.main(["build", "--quiet"]) == 0
    assert "130" in Path(RECORD).read_text()


def test_what_pre_commit_takes_back_leaves_nothing_half_done(make: Callable[[], None]) -> None:
    """pre-commit reverts hooks' writes to tracked files, if a stashed change concerns the same lines."""
    make()
    edit("ladder.json", '"ohm": 220.5},', '"ohm": 220.5},\n    {"name": "R3", "between": ["in", "out"], "ohm": 5},')
    git("add", "ladder.json")
    model = Path("modelica/Ladder/Ladder.mo")
    text = model.read_text()
    model.write_text(text.replace("Elements.R2 ", "  Elements.R2 "))
    assert "Rolling back fixes" in commit(code=1)
    assert "  Elements.R2 " in model.read_text(), "the change is back"
    assert Path("modelica/Ladder/Elements/R3.mo").is_file(), "it was not tracked, so it stays"
    git("checkout", "-q", str(model))
    assert cli.main(["build", "--quiet"]) == 0, "and is no conflict"
    git("add", ".")
    commit()
    assert "R3" in git("show", "HEAD:modelica/Ladder/Ladder.mo")


def call_by_script() -> None:
    """Let git call a script of the user's instead of pre-commit."""
    script = Path(".git/hooks/pre-commit")
    script.write_text(f"#!/bin/sh\nexec {sys.executable} -P -m urdfsync hook build\n")
    script.chmod(0o755)


@pytest.mark.parametrize("install", [lambda: None, call_by_script], ids=["pre-commit", "script"])
def test_partial_and_implicit_commits_have_an_index_of_their_own(
    make: Callable[[], None], install: Callable[[], None]
) -> None:
    make()
    install()
    resistor(120)
    Path("README").write_text("one")
    git("add", "README")
    assert "1 file written" in commit("--", "ladder.json", code=1)
    commit("--all")
    assert "120" in git("show", f"HEAD:{RECORD}")


@pytest.mark.skipif(sys.platform == "win32", reason="a daemon is ended by a signal")
def test_the_daemon_beside_it(make: Callable[[], None], project: Path, rc_site: Path) -> None:
    """The daemon builds the later change; a commit of earlier staged files neither loses nor contains this change."""
    make()
    store = os.environ["PRE_COMMIT_HOME"]
    quick = ("--settle", "50")
    with Watch(project, *quick, path=[rc_site, RC_FOLDER], PRE_COMMIT_HOME=store) as watch:
        watch.rest()
        for old, new in ((100, 120), (120, 130)):
            since = watch.mark
            resistor(new, before=old)
            watch.wait("built", lambda event: bool(event["files"]), since)
            watch.rest(since)
            git("add", ".")
            since = watch.mark
            resistor(new + 5, before=new)
            watch.wait("built", lambda event: bool(event["files"]), since)
            commit()
            assert str(new) in git("show", f"HEAD:{RECORD}"), "the staged source has its own outputs"
            assert f'"ohm": {new + 5}}}' in Path("ladder.json").read_text(), "the later change is back"
            since = watch.mark
            resistor(new, before=new + 5)
            watch.wait("built", lambda event: bool(event["files"]), since)
            watch.rest(since)
        watch.stop()
    assert cli.main(["build", "--check", "--quiet"]) == 0
    left = git("status", "--porcelain").splitlines()
    assert all(".urdfsync/bases/" in line for line in left), "texts of before go when their file is written again"


def test_the_hooks_are_what_pre_commit_expects() -> None:
    manifest = REPOSITORY / ".pre-commit-hooks.yaml"
    done = subprocess.run([PRE_COMMIT, "validate-manifest", manifest], check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    entries = [line.split()[1:] for line in manifest.read_text().splitlines() if line.strip().startswith("entry:")]
    assert entries == [["urdfsync", "hook", "build"], ["urdfsync", "hook", "check"]]
