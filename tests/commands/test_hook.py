"""`urdfsync hook` as git calls it: it judges the next commit, builds, and says what is not staged."""

from __future__ import annotations

import contextlib
import json
import os
import shlex
import shutil
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path
from unittest import mock

import pytest
from support import crashes, meshes, urdfs
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.networks import LADDER, MANIFEST, RECORD, ROBOT, configure, edit, resistor

from urdfsync.commands import cli
from urdfsync.project.state.lock import build_lock

pytestmark = [pytest.mark.slow, NEEDS_GIT]

Capture = pytest.CaptureFixture[str]


_committed: list[Path] = []
"""A copy of the repository that each test begins with, once the first one has made it."""


@pytest.fixture
def repo(
    project: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> Repository:
    """A repository with a network and its package, in step and committed; the working folder is its top."""
    monkeypatch.delenv("GIT_PREFIX", raising=False)
    if _committed:
        shutil.copytree(_committed[0], project, dirs_exist_ok=True)
        return Repository(project, monkeypatch)
    repository = Repository(project, monkeypatch)
    Path("notes.txt").write_text("notes\n")
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    _committed.append(tmp_path_factory.mktemp("committed") / "project")
    shutil.copytree(project, _committed[0])
    capsys.readouterr()
    return repository


def said(capsys: Capture, mode: str, *arguments: str, code: int | None = 1) -> list[str]:
    """What a hook prints, line by line."""
    capsys.readouterr()
    assert cli.main(["hook", mode, *arguments]) == code or code is None
    out, err = capsys.readouterr()
    return f"{err}{out}".splitlines()


def fault(message: str, hint: str = "", *, code: str = "out-of-step", robot: str = "ladder") -> str:
    """The line about a robot that does not pass."""
    then = ", which says what to add" if hint == BUILD else ", then commit again"
    return f"urdfsync.toml: error: robot `{robot}`: {message}{f'; run `{hint}`{then}' if hint else ''} [{code}]"


def run(line: str) -> None:
    """Run a command line, or the one that a finding of the hook has."""
    line = line.split("`")[3] if "`" in line else line
    for command in map(shlex.split, line.split(" && ")):
        if command[0] == "urdfsync":
            assert cli.main(command[1:]) in (0, 1)
        else:
            subprocess.run(command, check=True, capture_output=True)


BASE = ".urdfsync/bases/ladder/7"
"""Where the text of the record goes that a resistance of 120 gives."""
STATE = f"{BASE} {MANIFEST}"
STALE = '"ohm": 100}', '"ohm": 120}'
STAGE, DROP, BUILD = "git add ladder.json", "git rm -q --cached", "urdfsync hook build"


def add(*paths: str) -> str:
    """The command that adds files, which counts their paths from the top of the repository."""
    return " ".join(["git add", *(f":/{path}" for path in paths)])


ADD = add(BASE, MANIFEST, RECORD)
OUT, WAS_OUT = "the package is out of step: ", "the package was out of step, and has been built: "
NOT_STAGED = "the package is in step, but {} not staged"


@pytest.mark.parametrize(
    ("change", "commands", "mode", "words", "command"),
    [
        (STALE, STAGE, "build", f"{WAS_OUT}1 file written", ADD),
        (STALE, STAGE, "check", f"{OUT}1 file to write", BUILD),
        (STALE, f"urdfsync build && {STAGE}", "check", NOT_STAGED.format("3 files are"), ADD),
        (STALE, f"urdfsync build && {STAGE}", "build", NOT_STAGED.format("3 files are"), ADD),
        ((), f"{DROP} {RECORD}", "check", NOT_STAGED.format("1 file is"), add(RECORD)),
        ((), f"{DROP} ladder.json", "check", NOT_STAGED.format("1 file is"), add("ladder.json")),
        ((), f"{DROP} ladder.json", "build", NOT_STAGED.format("1 file is"), add("ladder.json")),
        ((), f"git rm -q {RECORD}", "check", f"{OUT}1 to restore", BUILD),
        ((), f"git rm -q {RECORD}", "build", f"{WAS_OUT}1 restored because you deleted it", add(RECORD)),
    ],
)  # fmt: skip
def test_what_is_not_in_step_or_not_staged_is_told_with_the_command_that_mends_it(
    repo: Repository, capsys: Capture, change: tuple[str, ...], commands: str, mode: str, words: str, command: str,
) -> None:  # fmt: skip
    """The source is changed, and the commands have been run. The check writes nothing, and none touches the index."""
    if change:
        edit("ladder.json", *change)
    run(commands)
    kind = "not-staged" if words.endswith("staged") else "out-of-step"
    index = Path(".git/index").read_bytes()
    with contextlib.nullcontext() if mode == "build" else unchanged(repo.folder):
        is_lost = mode == "check" and command == add("ladder.json")  # in a clone, this is an error of the source
        assert said(capsys, mode, code=2 if is_lost else 1) == [fault(words, command, code=kind)]
    assert Path(".git/index").read_bytes() == index
    if command == BUILD:
        command = said(capsys, "build")[-1]
    run(command)
    assert said(capsys, "build", code=0) == said(capsys, "check", code=0) == []


@pytest.mark.parametrize(
    "change", [lambda: resistor(120), lambda: Path(RECORD).unlink(), lambda: Path("ladder.json").write_text("{")]
)
def test_a_commit_that_touches_no_file_of_a_robot_passes(
    repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch, change: Callable[[], None]
) -> None:
    """Even if the last commit is out of step; by hand, with nothing staged at all, all robots are judged."""
    change()
    assert said(capsys, "check", code=0) == [], "nothing of it is staged"
    repo.commit()
    assert said(capsys, "check", code=None) != []
    Path("notes.txt").write_text("more")
    repo.git("add", "notes.txt")
    assert said(capsys, "check", code=0) == said(capsys, "build", code=0) == []
    repo.git("reset", "-q", "notes.txt")
    monkeypatch.setenv("GIT_INDEX_FILE", ".git/index")  # as git does, here for `git commit --amend`
    assert said(capsys, "check", code=0) == []


def test_a_new_name_counts_in_a_listed_folder_only_if_the_listing_would_have_it(
    repo: Repository, capsys: Capture
) -> None:
    """Builds list the visible folders and the Modelica files of the package's parents."""
    resistor(120)
    repo.commit()
    for name, code in (("notes.txt", 0), ("Mine.mo", 1), ("sub/notes.txt", 1)):
        path = Path("modelica", name)
        path.parent.mkdir(exist_ok=True)
        path.write_text("")
        repo.git("add", str(path))
        said(capsys, "check", code=code)
        repo.git("rm", "-qf", str(path))


@pytest.mark.parametrize("path", ["ladder.json", RECORD, MANIFEST, "urdfsync.toml"])
def test_of_a_file_that_is_staged_in_part_the_staged_part_counts(repo: Repository, capsys: Capture, path: str) -> None:
    resistor(120)
    run("urdfsync build")
    repo.git("add", ".")
    Path(path).write_text("not yet")
    assert said(capsys, "check", code=0) == said(capsys, "build", code=0) == []
    assert Path(path).read_text() == "not yet"


def test_a_file_that_git_was_told_not_to_look_at_is_named(repo: Repository, capsys: Capture) -> None:
    repo.git("update-index", "--assume-unchanged", RECORD)
    repo.git("update-index", "--skip-worktree", MANIFEST)
    assert said(capsys, "check", code=0) == [], "as the commit is"
    resistor(120)
    run("urdfsync build")
    repo.git("add", ".")
    (line,) = said(capsys, "check")
    assert f"git ignores changes of {MANIFEST}, {RECORD}; " in line
    repo.git("update-index", "--no-assume-unchanged", RECORD)
    repo.git("update-index", "--no-skip-worktree", MANIFEST)
    run(said(capsys, "check")[-1])
    assert said(capsys, "check", code=0) == []


def make_links(repo: Repository) -> None:
    """Let the source be behind a chain of links to folders; a second version of it is beside the first one."""
    for name, ohm in (("v1", 100), ("v2", 120)):
        Path("exports", name).mkdir(parents=True)
        Path("exports", name, "ladder.json").write_text(
            Path("ladder.json").read_text().replace('"ohm": 100}', f'"ohm": {ohm}}}')
        )
        Path("exports", name, "step.csv").write_bytes(Path("step.csv").read_bytes())
    Path("current").symlink_to("exports/v1")
    Path("robots").symlink_to("current")
    edit("urdfsync.toml", '"ladder.json"', '"robots/ladder.json"')
    run("urdfsync build --quiet")
    repo.commit()


def relink(path: str, target: str) -> None:
    """Let a link have another target."""
    Path(path).unlink()
    Path(path).symlink_to(target)


@pytest.mark.parametrize(("link", "target"), [("current", "exports/v2"), ("robots", "exports/v2")])
def test_a_link_to_a_folder_is_judged_as_it_is_staged(
    repo: Repository, capsys: Capture, link: str, target: str
) -> None:
    """Also one in the middle of a chain. The package of the new target is staged, and the link is not."""
    make_links(repo)
    relink(link, target)
    run("urdfsync build --quiet")
    repo.git("add", ".urdfsync", "modelica")
    assert said(capsys, "check") == [fault(NOT_STAGED.format("1 file is"), add(link), code="not-staged")]
    repo.git("add", link)
    assert said(capsys, "check", code=0) == []


def test_a_link_to_itself_in_the_working_copy_is_not_in_the_commit(repo: Repository, capsys: Capture) -> None:
    """Following it ended in an internal error, even with git told not to look at it."""
    make_links(repo)
    relink("current", "current")
    repo.git("update-index", "--assume-unchanged", "current")
    assert said(capsys, "check", code=0) == []


def make_workspace(repo: Repository, mesh: str = meshes.stl()) -> None:
    """Add a robot with a mesh in a ROS package, which only a search finds."""
    write_all({
        "share/deep/parts/package.xml": "<package><name>parts</name></package>",
        "share/deep/parts/a.stl": mesh,
        "arm.urdf": urdfs.robot(
            '<link name="base"><visual><geometry><mesh filename="package://parts/a.stl"/></geometry></visual></link>'
        ),
    })  # fmt: skip
    configure('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\npackage_paths = ["share"]\n')
    run("urdfsync build --quiet")
    repo.commit()


def write_all(texts: Mapping[str, str]) -> None:
    """Write texts by path."""
    for path, text in texts.items():
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text(text)


def test_the_next_commit_is_judged_without_a_plan(repo: Repository, capsys: Capture) -> None:
    run("urdfsync build --quiet")  # notes its work: the notes of a copied repository are not believed
    assert said(capsys, "check", code=0) == []
    Path("notes.txt").write_text("other notes\n")
    repo.git("add", "notes.txt")
    with mock.patch("urdfsync.engine.build.plan_robot") as plan:
        assert said(capsys, "check", code=0) == []
    assert not plan.called


@pytest.mark.parametrize("mark", ["COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"])
def test_a_file_that_hides_a_package_counts_only_in_the_commit(repo: Repository, capsys: Capture, mark: str) -> None:
    """It is deleted and not staged; then it is there and not tracked."""
    make_workspace(repo)
    write_all({f"share/again/{mark}": "", "share/again/parts/package.xml": "<package><name>parts</name></package>"})
    write_all({"share/again/parts/a.stl": meshes.stl(2)})
    repo.commit()
    assert said(capsys, "check", code=0) == []
    Path(f"share/again/{mark}").unlink()
    run("urdfsync build arm --quiet")
    repo.git("add", "modelica", ".urdfsync")
    line = fault(NOT_STAGED.format("1 file is"), add(f"share/again/{mark}"), code="not-staged", robot="arm")
    assert said(capsys, "check") == [line]
    repo.git("add", "-A")
    assert said(capsys, "check", code=0) == []
    repo.commit()
    Path(f"share/again/{mark}").touch()
    run("urdfsync build arm --quiet")
    repo.git("add", "modelica", ".urdfsync")
    assert said(capsys, "check") == [line]


def test_a_source_in_another_repository_counts_as_clones_have_it(repo: Repository, capsys: Capture) -> None:
    """First it is a nested repository, whose files are in no clone; then a submodule with changes of its own."""
    repo.git("init", "-q", "sub")
    Path("sub/ladder.json").write_bytes(Path("ladder.json").read_bytes())
    Path("sub/step.csv").write_bytes(Path("step.csv").read_bytes())
    run("git -C sub add . && git -C sub commit -q -m first && git clone -q --bare sub ../upstream")
    edit("urdfsync.toml", '"ladder.json"', '"sub/ladder.json"')
    run("urdfsync build --quiet")
    for command in ("git add urdfsync.toml .urdfsync modelica", "git add sub"):  # git adds only its commit
        run(command)
        line = said(capsys, "check", code=2)[-1]
        assert "in step here, but not in a clone: 1 error" in line
        assert "; commit the changes in sub, make it a submodule, and `git add` it [out-of-step]" in line
    run("git rm -q -f --cached sub && rm -rf sub && git -c protocol.file.allow=always submodule add -q ../upstream sub")
    repo.git("add", ".")
    assert said(capsys, "check", code=0) == []
    repo.commit()
    edit("sub/ladder.json", *STALE)
    run("urdfsync build --quiet")
    repo.git("add", ".")
    assert "commit the changes in sub" in said(capsys, "check")[-1]
    run("git -C sub commit -q -a -m next && git add sub")
    assert said(capsys, "check", code=0) == []


def test_attributes_count_as_in_a_clone(repo: Repository, capsys: Capture) -> None:
    """Git converts only new files to them in the working tree, but all files in a clone."""
    make_workspace(repo, meshes.stl().replace("tip", "$Id$"))
    Path(".gitattributes").write_text("share/**/*.stl ident\n")
    repo.git("add", ".gitattributes")
    assert "robot `arm`: the package is in step here, but not in a clone: " in said(capsys, "check")[-1]


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
    assert (f"`{add('.urdfsync/bases/ladder/2', MANIFEST, 'modelica/Ladder')}`" in line) is is_alone
    run(line)
    assert "D  modelica/Ladder/Elements/R2.mo\n" in repo.git("status", "--porcelain")
    assert ("?? modelica/Ladder/notes.txt" in repo.git("status", "--porcelain")) is not is_alone
    assert said(capsys, "check", code=0) == []


def add_robot(repo: Repository) -> None:
    """Commit a second robot, in step."""
    Path("other.json").write_bytes(Path("ladder.json").read_bytes())
    configure(ROBOT.format('"other.v2"', "Other").replace("ladder.json", "other.json"))
    run("urdfsync build")
    repo.commit()


def test_only_the_robots_of_the_commit_are_built(repo: Repository, capsys: Capture) -> None:
    add_robot(repo)
    for name in ("ladder.json", "other.json"):
        edit(name, '"ohm": 100}', '"ohm": 120}')
    repo.git("add", "other.json")
    with unchanged(repo.folder / LADDER):
        (line,) = said(capsys, "build", "--jobs", "2")
    assert f"robot `other.v2`: {WAS_OUT}1 file written; run `git add " in line
    repo.git("add", ".")
    (line,) = said(capsys, "build")
    assert line == fault(f"{WAS_OUT}1 file written", ADD)
    run(line)
    assert said(capsys, "check", code=0) == []


@pytest.mark.parametrize(
    ("path", "old", "new", "message"),
    [
        ("urdfsync.toml", "domain", "sorce = 1\ndomain", "urdfsync.toml:4: error: unknown key `sorce`"),
        ("ladder.json", '"R2"', '"R2', "ladder.json:8: error: "),
    ],
)
def test_an_error_has_its_file_and_line(
    repo: Repository, capsys: Capture, path: str, old: str, new: str, message: str
) -> None:
    edit(path, old, new)
    repo.git("add", path)
    for mode in ("check", "build"):
        lines = said(capsys, mode, code=2)
        assert any(line.startswith(message) for line in lines), lines


@pytest.mark.parametrize(("text", "code"), [("frames = all\n", "toml-syntax"), ("[check]\n", "no-robots")])
def test_a_broken_configuration_of_an_earlier_commit_is_told(
    repo: Repository, capsys: Capture, text: str, code: str
) -> None:
    """As in a clone, whatever the commit changes."""
    former = Path("urdfsync.toml").read_text() if code == "toml-syntax" else ""
    Path("urdfsync.toml").write_text(f"{former}{text}")
    repo.commit()
    Path("notes.txt").write_text("other")
    repo.git("add", "-A")
    (line,) = said(capsys, "check", code=2)
    assert line.startswith("urdfsync.toml:")
    assert line.endswith(f"[{code}]")


def test_a_conflict_comes_with_the_command_that_settles_it(repo: Repository, capsys: Capture) -> None:
    resistor(120)
    edit(RECORD, "100", "140")
    repo.git("add", ".")
    for mode in ("check", "build"):
        assert f"  urdfsync resolve {RECORD} --merge --prefer mine" in "\n".join(said(capsys, mode, code=3))
    run(f"urdfsync resolve {RECORD} --keep --quiet")
    (line,) = said(capsys, "check", code=3)
    assert "robot `ladder`: the package is in step, but 3 files are not staged; " in line
    run(line)
    assert said(capsys, "check", code=0) == []


@pytest.mark.parametrize("name", ["robots", "two words", "caf\xe9", "-x"])
def test_a_configuration_in_a_folder(
    repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """The commands work in any folder."""
    Path(name).mkdir()
    for file in ("ladder.json", "urdfsync.toml"):
        Path(name, file).write_bytes(Path(file).read_bytes())
        repo.git("add", "--", f"{name}/{file}")
    line = said(capsys, "build")[-1]
    run(line)
    assert said(capsys, "check", code=0) == []
    repo.commit()
    monkeypatch.chdir(name)
    resistor(120)
    repo.git("add", ".")
    run(said(capsys, "build")[-1])
    assert said(capsys, "check", code=0) == []
    repo.commit()
    monkeypatch.chdir(repo.folder)
    resistor(130)
    repo.git("add", ".")
    assert said(capsys, "check", "--config", f"{repo.folder}/{name}/urdfsync.toml", code=0) == []
    edit(f"{name}/ladder.json", "120", "140")
    repo.git("add", ".")
    words = fault(f"{OUT}1 file to write", BUILD).removeprefix("urdfsync.toml: ")
    assert said(capsys, "check") == [f"{name}/urdfsync.toml: {words}", f"urdfsync.toml: {words}"]


def test_a_configuration_that_is_not_tracked_is_told(repo: Repository, capsys: Capture) -> None:
    repo.git("rm", "-q", "--cached", "urdfsync.toml")
    assert f"`{add('urdfsync.toml')}`" in said(capsys, "check", code=2)[-1]
    repo.git("rm", "-q", "-r", "--cached", ".urdfsync")
    assert said(capsys, "check", code=0) == [], "then there is nothing to judge"
    assert "git add " in said(capsys, "check", "--config", "urdfsync.toml", code=2)[-1]
    repo.git("add", ".urdfsync")
    Path("urdfsync.toml").unlink()
    assert said(capsys, "check", code=0) == [], "the robot is gone, but for its state"
    assert "no-config" in said(capsys, "check", "--config", "typo.toml", code=2)[0]
    repo.git("reset", "-q", "--hard")
    Path("urdfsync.toml").unlink()
    assert said(capsys, "check", code=0) == [], "the commit has it"


def test_unmerged_files_are_an_error(repo: Repository, capsys: Capture) -> None:
    for branch, ohm in (("other", 120), ("main", 130)):
        repo.git("checkout", "-q", *(["-b"] if branch == "other" else []), branch)
        resistor(ohm)
        repo.commit()
    assert subprocess.run(["git", "merge", "-q", "other"], check=False, capture_output=True).returncode == 1
    assert said(capsys, "check", code=2)[0].startswith("ladder.json: error: the file is not merged yet")


def test_without_a_working_tree(project: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(project.parent))
    line = said(capsys, "check", code=2)[0]
    assert "error: git failed: not a git repository" in line
    assert line.endswith("[git]")


def test_a_further_working_tree_has_an_index_of_its_own(
    repo: Repository, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    repo.git("worktree", "add", "-q", "../second")
    resistor(110)
    repo.git("add", ".")
    monkeypatch.chdir("../second")
    monkeypatch.setenv("GIT_DIR", str(repo.folder / ".git/worktrees/second"))  # as git does for hooks
    assert said(capsys, "check", code=0) == []
    resistor(120)
    subprocess.run(["git", "add", "."], check=True)
    monkeypatch.setenv("GIT_LITERAL_PATHSPECS", "1")
    assert said(capsys, "build") == [fault(f"{WAS_OUT}1 file written", ADD)]


def test_a_source_in_a_submodule_is_staged_with_its_commit(repo: Repository, capsys: Capture) -> None:
    repo.git("clone", "-q", ".", "../other")
    repo.git("-c", "protocol.file.allow=always", "submodule", "add", "-q", f"{repo.folder.parent}/other", "sub")
    edit("urdfsync.toml", '"ladder.json"', '"sub/ladder.json"')
    run("urdfsync build")
    repo.commit()
    assert said(capsys, "check", code=0) == []
    edit("sub/ladder.json", '"ohm": 100}', '"ohm": 120}')
    run("git -C sub commit -q -a -m next && git add sub")
    line = said(capsys, "build")[-1]
    assert f"`{ADD}`" in line
    run(line)
    assert said(capsys, "check", code=0) == []
    repo.git("reset", "-q", "sub")
    assert f"`{add('sub')}`" in said(capsys, "check")[-1]


def test_no_program_of_the_settings_runs(repo: Repository, capsys: Capture) -> None:
    """Those of a clean filter do: what git would commit is its output."""
    for name in ("core.fsmonitor", "diff.external", "diff.evil.textconv", "core.pager", "core.editor"):
        repo.git("config", name, "touch ../evil; false")
    Path(".gitattributes").write_text("*.json diff=evil\n")
    resistor(120)
    repo.git("-c", "core.fsmonitor=false", "add", ".")
    Path("../evil").unlink(missing_ok=True)
    for _ in range(2):
        assert said(capsys, "build") != []
    assert not Path("../evil").exists()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a build is killed in a forked process")
def test_after_a_build_that_was_killed_the_commit_counts(repo: Repository, capsys: Capture, tmp_path: Path) -> None:
    """A clone does not have what the build was about to write."""
    resistor(120)
    (swap, *_) = crashes.operations(crashes.copy(repo.folder, tmp_path / "copy"), ["exchange"])
    crashes.kill(repo.folder, swap.number + 1)
    repo.git("add", ".")
    assert OUT in said(capsys, "check")[-1]
    run("urdfsync build")
    run(said(capsys, "build")[-1])
    assert said(capsys, "check", code=0) == []


def test_another_build_is_running(repo: Repository, capsys: Capture) -> None:
    resistor(120)
    repo.git("add", ".")
    with build_lock(repo.folder / ".urdfsync", wait=0) as lock:
        lock.acquire()
        assert "is building here" in "\n".join(said(capsys, "build", "--wait", "0", code=4))


def test_for_programs(repo: Repository, capsys: Capture) -> None:
    resistor(120)
    repo.git("add", ".")
    document = json.loads("\n".join(said(capsys, "check", "--format=json")))
    (found,) = document["diagnostics"]
    assert (document["command"], document["exit"], found["code"]) == ("hook", 1, "out-of-step")
    assert found["message"] == "robot `ladder`: the package is out of step: 1 file to write"
    assert found["hint"] == "run `urdfsync hook build`, which says what to add"
    assert [robot["robot"] for robot in document["results"]] == ["ladder"]
    repo.git("reset", "-q", "--hard")
    assert json.loads("\n".join(said(capsys, "check", "--format=json", code=0)))["diagnostics"] == []


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
