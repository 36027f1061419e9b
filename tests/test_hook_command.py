"""`urdfsync hook` as git calls it: what is staged is judged, whatever the working tree holds."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.networks import MANIFEST, RECORD, ROBOT, Snapshot, configure, edit, resistor

from urdfsync import cli, hook, precommit
from urdfsync.hooks.index import Index
from urdfsync.state.lock import build_lock

pytestmark = [pytest.mark.slow, NEEDS_GIT]

Capture = pytest.CaptureFixture[str]


_committed: list[Path] = []
"""A copy of the repository that each test begins with, once the first one has made it."""


@pytest.fixture
def repo(
    project: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> Repository:
    """A repository with a network and its package, in step and committed; the working folder is its top."""
    for name in ("GIT_PREFIX", "PRE_COMMIT", "PWD"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("PRE_COMMIT_HOME", str(project.parent / "pre-commit"))
    if _committed:
        shutil.copytree(_committed[0], project, dirs_exist_ok=True)
        return Repository(project, monkeypatch)
    repository = Repository(project, monkeypatch)
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    _committed.append(tmp_path_factory.mktemp("committed") / "project")
    shutil.copytree(project, _committed[0])
    capsys.readouterr()
    return repository


def said(capsys: Capture, mode: str, *arguments: str, code: int = 1) -> list[str]:
    """What a hook prints, line by line."""
    capsys.readouterr()
    assert cli.main(["hook", mode, *arguments]) == code
    out, err = capsys.readouterr()
    lines = f"{err}{out}".splitlines()
    told = [line for line in lines if line and not line.startswith(" ")]
    assert "--json" in arguments or len(set(told)) == len(told), "a finding is told once"
    return lines


def run(line: str) -> None:
    """Run a command line that a hook has printed."""
    for command in line.strip().split(" && "):
        if command.startswith("urdfsync "):
            assert cli.main(command.split(" ")[1:]) == 0
        else:
            subprocess.run(command.split(" "), check=True, capture_output=True)


def staged(repo: Repository) -> None:
    """Stage a change of the source that renews a record."""
    resistor(120)
    repo.git("add", "ladder.json")


STATE = f".urdfsync/robots/ladder.json {MANIFEST}"
STALE, ROUNDED = ('"ohm": 100}', '"ohm": 120}'), ('"ohm": 100}', '"ohm": 100.0}')
STAGE, DROP, BUILD = "git add ladder.json", "git rm -q --cached", "urdfsync build ladder && "
ADD = f"git add {STATE} {RECORD}"
OUT, IN = "ladder: out of step: ", "ladder: in step on disk, but "
RECORDED = f"{OUT}what urdfsync recorded of it is out of date"


@pytest.mark.parametrize(
    ("change", "commands", "mode", "words", "command"),
    [
        (STALE, STAGE, "build", f"{OUT}1 file written", ADD),
        (STALE, STAGE, "check", f"{OUT}1 file to write", f"{BUILD}{ADD}"),
        (STALE, f"urdfsync build && {STAGE} {RECORD}", "check", f"{IN}2 files are not staged", f"git add {STATE}"),
        (STALE, f"urdfsync build && {STAGE} {RECORD}", "build", f"{IN}2 files are not staged", f"git add {STATE}"),
        (ROUNDED, STAGE, "check", RECORDED, f"{BUILD}git add {STATE}"),
        (ROUNDED, STAGE, "build", RECORDED, f"git add {MANIFEST}"),
        ((), f"{DROP} {RECORD} && git add -N {RECORD}", "check", f"{IN}1 file is not staged", f"git add {RECORD}"),
        ((), f"{DROP} ladder.json", "check", f"{IN}1 file is not staged", "git add ladder.json"),
        ((), f"git rm -q {RECORD}", "check", f"{OUT}1 to restore", f"{BUILD}{ADD}"),
        ((), f"git rm -q {RECORD}", "build", f"{OUT}1 restored because you deleted it", f"git add {RECORD}"),
    ],
)  # fmt: skip
def test_what_is_not_in_step_is_told_with_the_command_that_mends_it(
    repo: Repository, capsys: Capture, change: tuple[str, ...], commands: str, mode: str, words: str, command: str,
) -> None:  # fmt: skip
    """The source is changed, and the commands have been run. The check writes nothing."""
    if change:
        edit("ladder.json", *change)
    run(commands)
    heading = "build, then add to the commit:" if command.startswith("urdfsync") else "add to the commit:"
    with contextlib.nullcontext() if mode == "build" else unchanged(repo.folder):
        assert said(capsys, mode) == [words, heading, f"  {command}"]
    run(command)
    assert said(capsys, "build", code=0) == said(capsys, "check", code=0) == []


@pytest.mark.parametrize(("pattern", "code"), [("*Parameters.mo", 1), ("ladder.json", 0)])
def test_files_that_git_is_told_to_ignore(repo: Repository, capsys: Capture, pattern: str, code: int) -> None:
    """An output has to be added all the same; a source is judged as it is on disk."""
    run(f"{DROP} {RECORD if code else 'ladder.json'}")
    Path(".gitignore").write_text(f"{pattern}\n")
    repo.git("add", ".gitignore")
    lines = said(capsys, "check", code=code)
    assert lines[-1:] == ([f"  git add -f {RECORD}"] if code else [])
    run(lines[-1] if code else "git status")
    assert said(capsys, "check", code=0) == []


def test_changes_that_are_not_staged_do_not_count(repo: Repository, capsys: Capture) -> None:
    def passes(what: str) -> None:
        for mode in ("build", "check"):
            assert said(capsys, mode, code=0) == [], what

    passes("nothing has changed")
    resistor(120)
    passes("the source")
    edit(RECORD, "100", "140")
    Path("modelica/Ladder/Ladder.mo").unlink()
    Path(MANIFEST).write_text("nonsense")
    passes("outputs and state")
    Path("urdfsync.toml").write_text("nonsense")
    passes("the configuration")


def test_a_source_with_later_changes_keeps_a_build_from_writing(repo: Repository, capsys: Capture) -> None:
    staged(repo)
    resistor(130, before=120)
    with unchanged(repo.folder):
        lines = said(capsys, "build")
        assert lines == [
            "ladder: out of step: 1 file to write; ladder.json has changes that are not staged",
            "stage the changes (git add ladder.json) or put them aside (git stash push --keep-index), then build:",
            f"  urdfsync build ladder && git add .urdfsync/robots/ladder.json {MANIFEST} {RECORD}",
        ]
    run("git stash push --keep-index")
    run(lines[-1])
    assert said(capsys, "build", code=0) == []
    run("git commit -qm staged")
    assert "120" in repo.git("show", f"HEAD:{RECORD}")


def test_a_part_of_the_edits_is_staged(repo: Repository, capsys: Capture) -> None:
    edit("modelica/Ladder/Ladder.mo", "end Ladder;", "  // mine\nend Ladder;")
    repo.git("add", ".")
    edit("modelica/Ladder/Ladder.mo", "// mine", "// mine and more")
    staged(repo)
    lines = said(capsys, "build")
    assert "Ladder.mo" not in lines[-1], "the rest of the edits stays where it is"
    run(lines[-1])
    assert said(capsys, "build", code=0) == []
    assert repo.git("status", "--porcelain", "modelica/Ladder/Ladder.mo") == "MM modelica/Ladder/Ladder.mo\n"


@pytest.mark.parametrize("is_alone", [True, False])
def test_an_element_that_is_gone_takes_its_files_with_it(repo: Repository, capsys: Capture, is_alone: bool) -> None:
    """They are named by their folder, or one by one if there is more in it."""
    edit("ladder.json", '    {"name": "R2", "between": ["middle", "out"], "ohm": 220.5},\n', "")
    edit("ladder.json", '"between": ["out"', '"between": ["middle"')
    repo.git("add", "ladder.json")
    if not is_alone:
        Path("modelica/Ladder/notes.txt").write_text("mine")
    line = said(capsys, "build")[-1]
    assert not Path("modelica/Ladder/Elements/R2.mo").exists()
    assert (line == "  git add .urdfsync/robots modelica/Ladder") is is_alone
    assert ("modelica/Ladder/Elements/R2.mo" in line.split(" ")) is not is_alone
    run(line)
    assert "D  modelica/Ladder/Elements/R2.mo\n" in repo.git("status", "--porcelain")
    assert ("?? modelica/Ladder/notes.txt" in repo.git("status", "--porcelain")) is not is_alone
    assert said(capsys, "check", code=0) == []


def add_robot(repo: Repository) -> None:
    """Commit a second robot, in step."""
    Path("other.json").write_bytes(Path("ladder.json").read_bytes())
    configure(ROBOT.format("other", "Other").replace("ladder.json", "other.json"))
    run("urdfsync build")
    repo.commit()


def test_robots_are_built_together_as_far_as_their_sources_are_staged(
    repo: Repository, capsys: Capture, snapshot_of: Snapshot
) -> None:
    add_robot(repo)
    for name in ("ladder.json", "other.json"):
        edit(name, '"ohm": 100}', '"ohm": 120}')
    repo.git("add", ".")
    resistor(130, before=120)
    before = snapshot_of(repo.folder / "modelica/Ladder")
    lines = said(capsys, "build")
    assert lines[:3] == [
        "ladder: out of step: 1 file to write; ladder.json has changes that are not staged",
        "other: out of step: 1 file written",
        "add to the commit:",
    ]
    assert snapshot_of(repo.folder / "modelica/Ladder") == before
    repo.git("checkout", ".")
    resistor(120, before=120)
    lines = said(capsys, "build", "--jobs", "2")
    assert lines[:2] == [f"{name}: out of step: 1 file written" for name in ("ladder", "other")]
    run(lines[-1])
    assert said(capsys, "check", code=0) == []


def test_a_robot_that_is_removed_with_its_source(repo: Repository, capsys: Capture) -> None:
    text = Path("urdfsync.toml").read_text()
    add_robot(repo)
    Path("urdfsync.toml").write_text(text)
    repo.git(
        "rm", "-q", "-r", "other.json", "modelica/Other", ".urdfsync/robots/other.toml", ".urdfsync/robots/other.json"
    )
    repo.git("add", "urdfsync.toml")
    assert said(capsys, "check", code=0) == []
    assert said(capsys, "build", code=0) == []


def test_a_source_that_the_commit_deletes(repo: Repository, capsys: Capture) -> None:
    repo.git("rm", "-q", "--cached", "ladder.json")
    Path("ladder.json").unlink()
    for mode in ("build", "check"):
        assert "does not exist" in said(capsys, mode, code=2)[0]


def test_a_configuration_is_judged_as_it_is_staged(repo: Repository, capsys: Capture) -> None:
    edit("urdfsync.toml", 'domain = "rcnetwork"', 'domain = "rcnetwork"\nprefix = "joint"')
    repo.git("add", "urdfsync.toml")
    edit("urdfsync.toml", "joint", "point")
    with unchanged(repo.folder):
        lines = said(capsys, "build")
        assert lines[0] == "ladder: out of step: 1 file to write; urdfsync.toml has changes that are not staged"
    edit("urdfsync.toml", "point", "joint")
    run(said(capsys, "build")[-1])
    assert said(capsys, "build", code=0) == []


@pytest.mark.parametrize(
    ("path", "change", "message"),
    [
        (
            "urdfsync.toml",
            lambda content: content.replace(b"domain", b"sorce = 1\ndomain"),
            "urdfsync.toml:4: error: unknown key `sorce` in robot `ladder`",
        ),
        ("ladder.json", lambda content: content[:100], "ladder.json:6: error: "),
    ],
)
def test_an_error_in_what_is_staged_has_its_file_and_line(
    repo: Repository, capsys: Capture, path: str, change: Callable[[bytes], bytes], message: str
) -> None:
    content = Path(path).read_bytes()
    Path(path).write_bytes(change(content))
    repo.git("add", path)
    Path(path).write_bytes(content)
    lines = said(capsys, "check", code=2)
    assert lines[0].startswith(message)
    assert "urdfsync-" not in "".join(lines), "the mirror is nobody's business"


def test_a_conflict_of_what_is_staged_comes_with_the_command_that_settles_it(repo: Repository, capsys: Capture) -> None:
    resistor(120)
    edit(RECORD, "100", "140")
    repo.git("add", ".")
    for mode in ("check", "build"):
        lines = said(capsys, mode, code=3)
        assert f"  urdfsync resolve {RECORD} --keep" in "\n".join(lines)
    run(f"urdfsync resolve {RECORD} --keep --quiet")
    lines = said(capsys, "check")
    assert lines[0] == "ladder: in step on disk, but 2 files are not staged"
    run(lines[-1])
    assert said(capsys, "check", code=0) == []


def test_a_mesh_or_table_is_judged_as_it_is_staged(repo: Repository, capsys: Capture) -> None:
    edit("step.csv", "0.1,5", "0.1,6")
    assert said(capsys, "check", code=0) == []
    repo.git("add", "step.csv")
    edit("step.csv", "0.1,6", "0.1,7")
    lines = said(capsys, "build")
    assert lines[0] == "ladder: out of step: 1 file to write; step.csv has changes that are not staged"
    edit("step.csv", "0.1,7", "0.1,6")
    lines = said(capsys, "build")
    run(lines[-1])
    assert said(capsys, "check", code=0) == []


def test_a_dependency_outside_of_the_repository_is_judged_as_it_is_on_disk(repo: Repository, capsys: Capture) -> None:
    Path("../tables").mkdir()
    Path("step.csv").rename("../tables/step.csv")
    edit("urdfsync.toml", "domain", 'package_paths = ["../tables"]\ndomain')
    run("urdfsync build")
    repo.commit()
    resistor(120)
    assert said(capsys, "check", code=0) == [], "found from the mirror, too"
    edit("../tables/step.csv", "0.1,5", "0.1,6")
    assert said(capsys, "check")[0].startswith("ladder: out of step: 1 file to write")


def test_configurations_below_the_top(repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("robots/left", "robots/right"):
        Path(name).mkdir(parents=True)
        Path(name, "ladder.json").write_bytes(Path("ladder.json").read_bytes())
        Path(name, "urdfsync.toml").write_bytes(Path("urdfsync.toml").read_bytes())
        run(f"urdfsync build --config {name}/urdfsync.toml")
    repo.git("add", ".")
    assert said(capsys, "check", code=0) == []
    monkeypatch.chdir("robots/left")
    resistor(120)
    repo.git("add", ".")
    assert said(capsys, "check")[-1].startswith("  urdfsync build ladder && git add .urdfsync/robots/ladder.json ")
    monkeypatch.chdir(repo.folder)
    monkeypatch.setenv("GIT_PREFIX", "robots/right/")
    lines = said(capsys, "check")
    assert lines[-1].startswith("  urdfsync build ladder --config ../left/urdfsync.toml && git add ../left/.urdfsync/")
    assert said(capsys, "check", "robots/right/urdfsync.toml", code=0) == []


def test_robots_of_two_configurations_are_told_apart(repo: Repository, capsys: Capture) -> None:
    Path("robots").mkdir()
    for name in ("ladder.json", "urdfsync.toml"):
        Path("robots", name).write_bytes(Path(name).read_bytes())
    repo.git("add", "robots")
    resistor(120)
    repo.git("add", ".")
    lines = said(capsys, "build")
    assert lines[:2] == [
        "ladder (robots/urdfsync.toml): out of step: 13 files written",
        "ladder (urdfsync.toml): out of step: 1 file written",
    ]
    run(lines[-1])
    assert said(capsys, "check", code=0) == []


def test_a_commit_without_the_configuration_of_its_state(repo: Repository, capsys: Capture) -> None:
    repo.git("rm", "-q", "--cached", "urdfsync.toml")
    assert said(capsys, "check", code=2)[0].startswith(
        f"{MANIFEST}: error: its configuration urdfsync.toml is not part"
    )
    assert said(capsys, "check", "urdfsync.toml", code=2)[0].startswith("urdfsync.toml: error: git does not track")
    repo.git("rm", "-q", "-r", "--cached", ".urdfsync")
    assert said(capsys, "check", code=0) == [], "then there is nothing to judge"


def test_unmerged_files_are_an_error(repo: Repository, capsys: Capture) -> None:
    repo.git("checkout", "-q", "-b", "other")
    resistor(120)
    repo.commit()
    repo.git("checkout", "-q", "main")
    resistor(130)
    repo.commit()
    assert subprocess.run(["git", "merge", "-q", "other"], check=False, capture_output=True).returncode == 1
    assert said(capsys, "check", code=2)[0].startswith("ladder.json: error: the file is not merged yet")


def test_outside_of_a_repository(project: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(project.parent))
    assert "error: git failed: not a git repository" in said(capsys, "check", code=2)[0]
    monkeypatch.setenv("PATH", str(project))
    assert "error: git is not installed" in said(capsys, "check", code=2)[0]


def test_another_build_is_running(repo: Repository, capsys: Capture) -> None:
    staged(repo)
    with build_lock(repo.folder / ".urdfsync", wait=0) as lock:
        lock.acquire()
        assert "is building here" in said(capsys, "build", "--wait", "0", code=4)[0]


def test_all_ways_in_which_index_and_working_tree_can_differ(
    repo: Repository, capsys: Capture, snapshot_of: Snapshot
) -> None:
    """Sources and outputs of two versions, in the index and on disk; which of the two is staged makes no difference."""
    sources, outputs = ["ladder.json"], [RECORD, MANIFEST, ".urdfsync/robots/ladder.json"]
    first = {path: Path(path).read_bytes() for path in (*sources, *outputs)}
    resistor(120)
    run("urdfsync build")
    versions = [first, {path: Path(path).read_bytes() for path in first}]
    for staged, built, source, output in itertools.product((1,), (0, 1), (0, 1), (0, 1)):
        put(versions[staged], sources)
        put(versions[built], outputs)
        repo.git("add", "--all")
        put(versions[source], sources)
        put(versions[output], outputs)
        os.utime(RECORD, (1, 1))  # git would like to note that in the index
        index, before = (repo.folder / ".git/index").read_bytes(), snapshot_of(repo.folder / "modelica")
        code = 0 if staged == built else 1
        assert bool(said(capsys, "check", code=code)) == bool(code)
        assert snapshot_of(repo.folder / "modelica") == before
        assert bool(said(capsys, "build", code=code)) == bool(code)
        assert (repo.folder / ".git/index").read_bytes() == index
        written = versions[source] if code and staged == source else versions[output]
        assert Path(RECORD).read_bytes() == written[RECORD]


def put(version: Mapping[str, bytes], paths: Sequence[str]) -> None:
    for path in paths:
        Path(path).write_bytes(version[path])


def test_changes_that_pre_commit_will_bring_back_keep_a_build_from_writing(
    repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stash(*paths: str) -> None:
        monkeypatch.setattr(precommit, "find_stash", lambda _: (Path("patch"), 1))
        monkeypatch.setattr(Index, "patched", lambda *_: {"notes.txt", *paths})

    resistor(120)
    repo.git("add", ".")
    with unchanged(repo.folder / "modelica"):
        for path in ("ladder.json", "step.csv", RECORD, MANIFEST, "urdfsync.toml"):
            stash(path)
            line = f"ladder: out of step: 1 file to write; {path} has changes that are not staged"
            assert said(capsys, "build")[0] == line
        repo.git("rm", "-q", "-r", "--cached", ".urdfsync")
        stash()
        said(capsys, "build")
    repo.git("add", ".urdfsync")
    assert said(capsys, "build")[0] == "ladder: out of step: 1 file written"


def test_for_programs(repo: Repository, capsys: Capture) -> None:
    staged(repo)
    document = json.loads("\n".join(said(capsys, "check", "--json")))
    (found,) = document["diagnostics"]
    assert (document["command"], document["exit"], found["code"]) == ("hook", 1, "out-of-step")
    assert found["message"] == "robot `ladder`: out of step: 1 file to write"
    assert found["hint"].startswith("`urdfsync build ladder && git add ")
    assert [robot["name"] for robot in document["robots"]] == ["ladder"]
    repo.git("add", ".")
    repo.git("reset", "-q", "--hard")
    assert json.loads("\n".join(said(capsys, "check", "--json", code=0)))["diagnostics"] == []


def test_the_script_is_the_command(repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["urdfsync-hook", "check"])
    assert hook.main() == 0
    resistor(120)
    assert hook.main() == 0
    repo.git("add", "ladder.json")
    assert hook.main() == 1
    assert "".join(capsys.readouterr()).splitlines() == said(capsys, "check")


def test_whatever_passes_is_in_step_in_a_clone(
    repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    resistor(120)
    edit("modelica/Ladder/Ladder.mo", "end Ladder;", "  // mine\nend Ladder;")
    repo.git("add", ".")
    run(said(capsys, "build")[-1])
    assert said(capsys, "check", code=0) == []
    repo.git("commit", "-qm", "next")
    repo.git("clone", "-q", ".", "../clone")
    monkeypatch.chdir("../clone")
    assert cli.main(["build", "--check", "--quiet"]) == 0
    assert said(capsys, "check", code=0) == []
