"""`urdfsync hook` as git calls it: what is staged is judged, whatever the working tree holds."""

from __future__ import annotations

import itertools
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest
from support.git import NEEDS_GIT, Repository
from support.networks import MANIFEST, RECORD, ROBOT, Snapshot, edit, resistor

from urdfsync import cli, hook
from urdfsync.hooks.index import Index
from urdfsync.state.lock import build_lock
from urdfsync.watch import precommit

pytestmark = [pytest.mark.slow, NEEDS_GIT]

Capture = pytest.CaptureFixture[str]
MODEL = "modelica/Ladder/Ladder.mo"
STATE = f".urdfsync/robots/ladder.json {MANIFEST}"


@pytest.fixture(scope="module")
def committed() -> list[Path]:
    """A copy of the repository that each test begins with, once the first one has made it."""
    return []


@pytest.fixture
def repo(
    project: Path,
    committed: list[Path],
    tmp_path_factory: pytest.TempPathFactory,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Capture,
) -> Repository:
    """A repository with a network and its package, in step and committed; the working folder is its top."""
    for name in ("GIT_PREFIX", "PRE_COMMIT", "PWD"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("PRE_COMMIT_HOME", str(project.parent / "pre-commit"))
    if committed:
        shutil.copytree(committed[0], project, dirs_exist_ok=True)
        return Repository(project, monkeypatch)
    repository = Repository(project, monkeypatch)
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    committed.append(shutil.copytree(project, tmp_path_factory.mktemp("committed") / "project"))
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


def git(*arguments: str) -> str:
    return subprocess.run(["git", *arguments], check=True, capture_output=True, text=True).stdout


def run(line: str) -> None:
    """Run a command line that a hook has printed."""
    for command in line.strip().split(" && "):
        program, *arguments = command.split(" ")
        if program == "urdfsync":
            assert cli.main(arguments) == 0
        else:
            git(*arguments)


def do_as_told(capsys: Capture, lines: Sequence[str]) -> None:
    """Run the last line; then both hooks have nothing to say."""
    run(lines[-1])
    for mode in ("check", "build"):
        assert said(capsys, mode, code=0) == []


def test_a_stale_output_is_built_and_has_to_be_added(
    repo: Repository, capsys: Capture, snapshot_of: Snapshot, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The check says what to do, and writes nothing. The program `urdfsync-hook` is the command."""
    monkeypatch.setattr(sys, "argv", ["urdfsync-hook", "check"])
    resistor(120)
    assert hook.main() == 0, "what is not staged does not count"
    repo.git("add", "ladder.json")
    before = snapshot_of(repo.folder)
    assert said(capsys, "check") == [
        "ladder: out of step: 1 file to write",
        "build, then add to the commit:",
        f"  urdfsync build ladder && git add {STATE} {RECORD}",
    ]
    assert hook.main() == 1
    assert snapshot_of(repo.folder) == before
    lines = said(capsys, "build")
    assert lines == ["ladder: out of step: 1 file written", "add to the commit:", f"  git add {STATE} {RECORD}"]
    assert "120" in Path(RECORD).read_text()
    do_as_told(capsys, lines)
    assert git("status", "--porcelain").splitlines() == [
        f"M  {path}" for path in (*STATE.split(), "ladder.json", RECORD)
    ]


def test_changes_that_are_not_staged_do_not_count(repo: Repository, capsys: Capture) -> None:
    for path in ("ladder.json", RECORD, MANIFEST, "urdfsync.toml"):
        Path(path).write_text("nonsense")
        for mode in ("build", "check"):
            assert said(capsys, mode, code=0) == [], path


@pytest.mark.parametrize(
    ("path", "old", "staged", "later"),
    [
        ("ladder.json", '"ohm": 100}', '"ohm": 120}', '"ohm": 130}'),
        ("step.csv", "0.1,5", "0.1,6", "0.1,7"),
        ("urdfsync.toml", "rcnetwork", 'rcnetwork"\nprefix = "joint', 'rcnetwork"\nprefix = "point'),
    ],
)
def test_later_changes_of_what_is_staged_keep_a_build_from_writing(
    repo: Repository, capsys: Capture, snapshot_of: Snapshot, path: str, old: str, staged: str, later: str
) -> None:
    """A source, a table or mesh, and the configuration are judged as they are staged."""
    edit(path, old, staged)
    repo.git("add", path)
    edit(path, staged, later)
    before = snapshot_of(repo.folder)
    lines = said(capsys, "build")
    assert lines[:2] == [
        f"ladder: out of step: 1 file to write; {path} has changes that are not staged",
        f"stage the changes (git add {path}) or put them aside (git stash push --keep-index), then build:",
    ]
    assert lines[2].startswith("  urdfsync build ladder && git add ")
    assert snapshot_of(repo.folder) == before
    run("git stash push --keep-index")
    do_as_told(capsys, lines)


def test_a_part_of_the_edits_is_staged(repo: Repository, capsys: Capture) -> None:
    edit(MODEL, "end Ladder;", "  // mine\nend Ladder;")
    repo.git("add", ".")
    edit(MODEL, "// mine", "// mine and more")
    resistor(120)
    repo.git("add", "ladder.json")
    lines = said(capsys, "build")
    assert "Ladder.mo" not in lines[-1], "the rest of the edits stays where it is"
    do_as_told(capsys, lines)
    assert git("status", "--porcelain", MODEL) == f"MM {MODEL}\n"


def built_but_not_staged(repo: Repository) -> None:
    resistor(120)
    run("urdfsync build")
    repo.git("add", "ladder.json", RECORD)


def ignored(repo: Repository) -> None:
    repo.git("rm", "-q", "--cached", RECORD)
    Path(".gitignore").write_text("*Parameters.mo\n")
    repo.git("add", ".gitignore")


def not_tracked(repo: Repository) -> None:
    repo.git("rm", "-q", "--cached", "ladder.json")


def to_be_added_one_day(repo: Repository) -> None:
    repo.git("rm", "-q", "--cached", RECORD)
    repo.git("add", "--intent-to-add", RECORD)


def deleted(repo: Repository) -> None:
    repo.git("rm", "-q", RECORD)


def changed_in_the_state_only(repo: Repository) -> None:
    edit("ladder.json", '"ohm": 100}', '"ohm": 100.0}')
    repo.git("add", "ladder.json")


def conflicting(repo: Repository) -> None:
    """The user has kept his number."""
    resistor(120)
    edit(RECORD, "100", "140")
    repo.git("add", ".")
    assert cli.main(["build", "--quiet"]) == 3
    run(f"urdfsync resolve {RECORD} --keep --quiet")


@pytest.mark.parametrize(
    ("arrange", "first", "last"),
    [
        (built_but_not_staged, "ladder: in step on disk, but 2 files are not staged", f"  git add {STATE}"),
        (ignored, "ladder: in step on disk, but 1 file is not staged", f"  git add -f {RECORD}"),
        (not_tracked, "ladder", "  git add ladder.json"),
        (to_be_added_one_day, "ladder", f"  git add {RECORD}"),
        (deleted, "ladder: out of step: 1 restored because you deleted it", f"  git add {RECORD}"),
        (
            changed_in_the_state_only,
            "ladder: out of step: what urdfsync recorded of it is out of date",
            f"  git add {MANIFEST}",
        ),
        (conflicting, "ladder: in step on disk, but 2 files are not staged", "  git add"),
    ],
)
def test_what_is_not_staged_is_named_with_the_command_that_adds_it(
    repo: Repository, capsys: Capture, arrange: Callable[[Repository], None], first: str, last: str
) -> None:
    arrange(repo)
    said(capsys, "check")
    lines = said(capsys, "build")
    assert lines[0].startswith(first)
    assert lines[-1].startswith(last)
    do_as_told(capsys, lines)


def test_a_source_that_is_ignored_on_purpose_is_judged_as_it_is_on_disk(repo: Repository, capsys: Capture) -> None:
    not_tracked(repo)
    Path(".gitignore").write_text("ladder.json\n")
    repo.git("add", ".gitignore")
    assert said(capsys, "check", code=0) == []


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
    assert "D  modelica/Ladder/Elements/R2.mo\n" in git("status", "--porcelain")
    assert ("?? modelica/Ladder/notes.txt" in git("status", "--porcelain")) is not is_alone
    assert said(capsys, "check", code=0) == []


def add_robot(repo: Repository) -> None:
    """Commit a second robot, in step."""
    Path("other.json").write_bytes(Path("ladder.json").read_bytes())
    with Path("urdfsync.toml").open("a") as file:
        file.write(ROBOT.format("other", "Other").replace("ladder.json", "other.json"))
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


def cut_off(repo: Repository) -> None:
    Path("ladder.json").write_bytes(Path("ladder.json").read_bytes()[:100])


def wrong_key(repo: Repository) -> None:
    edit("urdfsync.toml", "domain", "sorce = 1\ndomain")


def gone(repo: Repository) -> None:
    Path("ladder.json").unlink()


def with_markers(repo: Repository) -> None:
    state = Path(MANIFEST).read_text()
    Path(MANIFEST).write_text(f"<<<<<<< ours\n{state}=======\n{state}>>>>>>> theirs\n")


def in_conflict(repo: Repository) -> None:
    resistor(120)
    edit(RECORD, "100", "140")


def without_configuration(repo: Repository) -> None:
    Path("urdfsync.toml").unlink()


def unmerged(repo: Repository) -> None:
    repo.git("checkout", "-q", "-b", "other")
    for branch, ohm in (("other", 120), ("main", 130)):
        repo.git("checkout", "-q", branch)
        resistor(ohm)
        repo.commit()
    assert subprocess.run(["git", "merge", "-q", "other"], check=False, capture_output=True).returncode == 1


@pytest.mark.parametrize(
    ("arrange", "code", "words"),
    [
        (cut_off, 2, "ladder.json:6: error: "),
        (wrong_key, 2, "urdfsync.toml:4: error: unknown key `sorce` in robot `ladder`"),
        (gone, 2, "does not exist"),
        (with_markers, 2, "urdfsync build --repair"),
        (in_conflict, 3, f"  urdfsync resolve {RECORD} --keep"),
        (without_configuration, 2, f"{MANIFEST}: error: its configuration urdfsync.toml is not part"),
        (unmerged, 2, "ladder.json: error: the file is not merged yet"),
    ],
)
def test_an_error_in_what_is_staged_is_told(
    repo: Repository, capsys: Capture, arrange: Callable[[Repository], None], code: int, words: str
) -> None:
    arrange(repo)
    if arrange is not unmerged:
        repo.git("add", ".")
    for mode in ("check", "build"):
        lines = "\n".join(said(capsys, mode, code=code))
        assert words in lines
        assert "urdfsync-" not in lines, "the checkout of what is staged is nobody's business"


def test_what_has_no_state_and_no_configuration_is_not_judged(repo: Repository, capsys: Capture) -> None:
    repo.git("rm", "-q", "-r", "--cached", "urdfsync.toml", ".urdfsync")
    assert said(capsys, "check", code=0) == []
    assert said(capsys, "check", "urdfsync.toml", code=2)[0].startswith("urdfsync.toml: error: git does not track")


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


def test_outside_of_a_repository(project: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(project.parent))
    assert "error: git failed: not a git repository" in said(capsys, "check", code=2)[0]
    monkeypatch.setenv("PATH", str(project))
    assert "error: git is not installed" in said(capsys, "check", code=2)[0]


def test_another_build_is_running(repo: Repository, capsys: Capture) -> None:
    resistor(120)
    repo.git("add", "ladder.json")
    with build_lock(repo.folder, repo.folder / ".urdfsync", wait=0) as lock:
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
    repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch, snapshot_of: Snapshot
) -> None:
    def stash(*paths: str) -> None:
        monkeypatch.setattr(precommit, "find_stash", lambda _: (Path("patch"), 1))
        monkeypatch.setattr(Index, "patched", lambda *_: {"notes.txt", *paths})

    resistor(120)
    repo.git("add", ".")
    before = snapshot_of(repo.folder / "modelica")
    for path in ("ladder.json", "step.csv", RECORD, MANIFEST, "urdfsync.toml"):
        stash(path)
        line = f"ladder: out of step: 1 file to write; {path} has changes that are not staged"
        assert said(capsys, "build")[0] == line
    repo.git("rm", "-q", "-r", "--cached", ".urdfsync")
    stash()
    said(capsys, "build")
    assert snapshot_of(repo.folder / "modelica") == before, "a roll-back must not leave an untracked state alone"
    repo.git("add", ".urdfsync")
    assert said(capsys, "build")[0] == "ladder: out of step: 1 file written"


def test_for_programs(repo: Repository, capsys: Capture) -> None:
    resistor(120)
    repo.git("add", "ladder.json")
    document = json.loads("\n".join(said(capsys, "check", "--json")))
    (found,) = document["diagnostics"]
    assert (document["command"], document["exit"], found["code"]) == ("hook", 1, "out-of-step")
    assert found["message"] == "robot `ladder`: out of step: 1 file to write"
    assert found["hint"].startswith("`urdfsync build ladder && git add ")
    assert [robot["name"] for robot in document["robots"]] == ["ladder"]
    repo.git("add", ".")
    repo.git("reset", "-q", "--hard")
    assert json.loads("\n".join(said(capsys, "check", "--json", code=0)))["diagnostics"] == []
