"""A command that has nothing to do says so without being run, as long as running it would say the same."""

from __future__ import annotations

import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

import pytest
from benchmarks.robots import write_workspace
from hypothesis import given
from hypothesis import strategies as st
from support.cases import often
from support.meshes import stl
from support.remembered import save, saved
from support.screen import print_on_terminal

from urdfsync.commands import cli
from urdfsync.common import noop
from urdfsync.common.dependencies import facts, program
from urdfsync.common.dependencies.memory import Memory, Remembered
from urdfsync.engine.inspect import last_build
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.engine.remembered import RobotMemory

Capture = pytest.CaptureFixture[str]
Edit = Callable[[Path], object]

BUILD, CHECK, STATUS = ["build"], ["build", "--check"], ["status"]
DEPS = ".urdfsync/deps"
LEG = "modelica/Leg/Links/Tip.mo"
URDF = "robots/leg.urdf"
IN_STEP = "arm: in step, 17 files, 1 kept because you edited it\nleg: in step, 16 files, 1 kept because you edited it"


@pytest.fixture(autouse=True)
def _soon_old(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(facts, "YOUNG", 50_000_000)  # else each test would wait for two seconds


@pytest.fixture
def folder(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project in step, which is the working folder; nothing is remembered of it."""
    place = tmp_path / "project"
    shutil.copytree(in_step, place)
    shutil.rmtree(place / DEPS, ignore_errors=True)
    (place / ".urdfsync/robots/gone.state").unlink()
    monkeypatch.chdir(place)
    return place


# What is said without a run


@pytest.mark.parametrize(
    "command", [BUILD, CHECK, ["build", "-n"], ["build", "leg"], ["build", "-q"], ["build", "leg", "arm", "-q"]]
)
def test_what_a_command_would_say(folder: Path, command: list[str], capsys: Capture) -> None:
    save(*BUILD)
    capsys.readouterr()
    assert cli.main(command) == 0
    said = capsys.readouterr()
    assert noop.answer(command) == ""
    assert capsys.readouterr() == said
    assert "in step" in said.out or "-q" in command


def test_status_of_a_package_that_nobody_edited(folder: Path, capsys: Capture) -> None:
    save(*BUILD)
    assert saved(*STATUS) is None, "it lists edited files"
    for path in ("modelica/Leg/Links/TipParameters.mo", "modelica/Lab/Arm/Links/Base/package.mo"):
        Path(path).unlink()
    shutil.rmtree("modelica/Lab/Arm/Links/Base")
    assert cli.main(BUILD) == 0
    save(*STATUS)
    capsys.readouterr()
    assert noop.answer(STATUS) == ""
    assert capsys.readouterr().out == "arm: in step, 17 files\nleg: in step, 16 files\n"


def test_findings_are_counted_once_a_build_has_told_them(folder: Path, capsys: Capture) -> None:
    Path(URDF).write_text(Path(URDF).read_text().replace("</robot>", '<gazebo><odd_one value="1"/></gazebo></robot>'))
    time.sleep(0.1)
    for command, is_new in ((CHECK, True), (BUILD, True), (BUILD, False), (CHECK, False)):
        capsys.readouterr()
        if noop.answer(command) is None:
            cli.main(command)
        said = capsys.readouterr().err
        assert ("odd_one" in said, "still 1 finding" in said) == (is_new, not is_new), command
        time.sleep(0.1)
    assert saved(*BUILD) is not None


USERS = "another user, who may not read all that", "a user of other groups"
SURROUNDINGS: dict[str, Callable[[pytest.MonkeyPatch], object]] = {
    "paths look different from here": lambda patch: patch.chdir("robots"),
    "folders of packages": lambda patch: patch.setenv("ROS_PACKAGE_PATH", str(Path.cwd())),
    "folders of libraries": lambda patch: patch.setenv("MODELICAPATH", str(Path.cwd())),
    "another urdfsync": lambda patch: patch.setattr(program, "_identities", {(): "another"}),
    USERS[0]: lambda patch: patch.setattr(os, "geteuid", lambda: 12345, raising=False),
    USERS[1]: lambda patch: patch.setattr(os, "getgroups", lambda: [12345], raising=False),
}


@pytest.mark.parametrize("name", [
    pytest.param(name, marks=[pytest.mark.posix("its users have folders of their own")] * (name in USERS))
    for name in SURROUNDINGS
])  # fmt: skip
def test_what_is_remembered_belongs_to_the_folder_the_environment_and_the_program(
    folder: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    save(*BUILD)
    with monkeypatch.context() as patch:
        SURROUNDINGS[name](patch)
        assert saved(*BUILD) is None
    assert saved(*BUILD) is not None


def test_a_configuration_that_is_named(folder: Path) -> None:
    Path("urdfsync.toml").rename("robots.toml")
    save("build", "--config", "robots.toml")
    assert saved("build", "--config=./robots.toml") is not None


@pytest.mark.parametrize(
    "command",
    [["build", "--full"], ["build", "--svg"], ["build", "--merge"], ["diff"], ["build", "nobody"], ["build", URDF],
     ["build", "-v"], ["build", "--format", "json"], ["build", "--check", "--dry-run"], ["status", "--check"], []],
)  # fmt: skip
def test_what_has_to_run(folder: Path, command: list[str], capsys: Capture) -> None:
    save(*BUILD)
    assert saved(*command) is None


@pytest.mark.parametrize("command", [BUILD, CHECK, STATUS])
def test_after_a_build_that_wrote_one_more_command_has_to_run(folder: Path, command: list[str]) -> None:
    save(*BUILD)
    Path(LEG).unlink()
    for _ in range(2):
        assert saved(*BUILD) is None
        assert cli.main(BUILD if Path(LEG).exists() is False else command) == 0
    lines = saved(*BUILD)
    assert lines is not None
    assert [f"{robot}: {words}" for robot, words, *_ in lines] == IN_STEP.splitlines()


def test_the_result_of_a_table_of_10_000_rows_is_remembered(folder: Path) -> None:
    """It has 20,000 actions, in 9 MB."""
    result = os.urandom(9_000_000)
    time.sleep(0.1)
    records = Memory(".urdfsync")
    records.save("motors.robot", "key", Remembered({}, ["in step"], result))
    found = records.recall("motors.robot", "key")
    assert found is not None
    assert found.result == result
    assert records.recall("motors.robot", "another key") is None


def test_packages_that_builds_check_have_to_be_checked(folder: Path) -> None:
    Path("urdfsync.toml").write_text('[defaults]\non_build = "check"\n' + Path("urdfsync.toml").read_text()[11:])
    for _ in range(2):
        assert cli.main(CHECK) == 0
        time.sleep(0.1)
    assert saved(*BUILD) is None


# What it depends on


def _edit(path: str, what: str = "other", how: str = "write", *, old: bool = False) -> Edit:
    """A change of a file, as `_bring` makes it."""
    return lambda folder: _bring(folder / path, what, how, old, _state(folder / path))


def _link_package(folder: Path) -> None:
    (folder / "modelica/Leg").rename(folder / "moved")
    (folder / "modelica/Leg").symlink_to(folder / "moved")


EDITS: dict[str, Edit] = {
    **{
        f"{what} {how} {path}": _edit(path, what, how, old=True)
        for path in (URDF, LEG)
        for what, how in (("other", "write"), ("first", "replace"), ("absent", "write"), ("first", "link"))
    },
    **{
        f"other write {path}": _edit(path, old=True)
        for path in (
            *("urdfsync.toml", "robots/leg_meshes/base.stl", ".urdfsync/robots/leg.state"),
            *("modelica/Leg/package.order",),
        )
    },
    "a mesh that is better placed": _edit("robots/arm_meshes/base.stl"),
    "a package that hides another": _edit("ros/a/package.xml"),
    "a folder to be ignored": _edit("ros/group/COLCON_IGNORE"),
    "a class of the user's in the package": _edit("modelica/Lab/Arm/Links/Own.mo"),
    "a model of the user's": _edit("models/deep/Own.mo"),
    "a template": _edit("own/link.mo.jinja"),
    "a folder of templates": _edit("own/notes/deep/readme.txt"),
    "a parent that is gone": _edit("modelica/Lab/package.mo", "absent"),
    "a parent's single file": _edit("modelica/Lab.mo"),
    "a package above all": _edit("modelica/package.mo"),
    "a class that is a folder": lambda folder: (folder / LEG).rename(folder / "modelica/Leg/Links/package2.mo"),
    "a folder that is a class": _edit("modelica/Lab/Arm/Links/Base/package.mo", "absent"),
    "another stray state": _edit(".urdfsync/robots/other.state"),
    "bases that are lost": lambda folder: shutil.rmtree(folder / ".urdfsync/bases/leg"),
    "a file that may not be read": lambda folder: (folder / URDF).chmod(0),
    "a linked folder": _link_package,
    "a search path that comes": _edit("later/src/leg_meshes/package.xml"),
    "a mark of a package, by a link": lambda folder: (folder / "target").rmdir(),
}
if os.name == "posix" and os.geteuid():  # the superuser may read each folder anyway
    EDITS["a folder that may be read at last"] = lambda folder: (folder / "ros/closed").chmod(0o700)


@pytest.mark.parametrize("name", EDITS)
def test_every_dependency_counts(folder: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder / "later"))
    (folder / "ros/closed").mkdir(mode=0)
    (folder / "ros/marked").mkdir()
    (folder / "target").mkdir()
    (folder / "ros/marked/package.xml").symlink_to(folder / "target")
    save(*BUILD)
    assert saved(*BUILD) is not None
    EDITS[name](folder)
    assert saved(*BUILD) is None


def test_so_does_a_library_that_comes_to_modelicapath(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MODELICAPATH", str(folder / "libraries"))
    source = Path(URDF).read_text()
    assert "package://leg_meshes/" in source
    Path(URDF).write_text(source.replace("package://leg_meshes/", "modelica://LegMeshes/"))
    save(*BUILD)
    assert saved(*BUILD) is not None
    _edit("libraries/LegMeshes 2.0/package.mo")(folder)
    assert saved(*BUILD) is None


def test_what_does_not_matter_does_not_end_it(folder: Path) -> None:
    save(*BUILD)
    for path in ("notes.txt", "modelica/notes.txt", "modelica/Leg/notes.txt", "robots/other.urdf", ".urdfsync/own.txt"):
        _edit(path)(folder)
    assert saved(*BUILD) is not None


MESH = "robots/leg_meshes/base.stl"
MESHES: dict[str, tuple[Edit, str]] = {
    "deleted": (_edit(MESH, "absent"), "mesh `package://leg_meshes/base.stl` not found; the imported copy is kept"),
    "no mesh any more": (lambda folder: (folder / MESH).write_text("solid"), "the imported copy is kept"),
    "replaced": (lambda folder: (folder / MESH).write_text(stl().replace("0", "7", 1)), "modelica/Leg/Resources/base_"),
    "of the same size and time": (_edit(MESH, old=True), "modelica/Leg/Resources/base_"),
}


@pytest.mark.parametrize("command", [BUILD, CHECK])
@pytest.mark.parametrize("name", MESHES)
def test_what_becomes_of_a_source_mesh_is_told(folder: Path, command: list[str], name: str, capsys: Capture) -> None:
    save(*command)
    edit, words = MESHES[name]
    edit(folder)
    assert saved(*command) is None
    capsys.readouterr()
    cli.main([*command, "--verbose"])
    said = capsys.readouterr()
    assert words in (said.out + said.err).replace(os.sep, "/")
    assert cli.main(["build", "--check", "-q"]) == (not name.startswith(("deleted", "no")) and command is not BUILD)


# When it is remembered


@pytest.mark.parametrize("path", [URDF, LEG])
def test_young_files_are_compared_by_content(folder: Path, path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The clock of a file system may stand still between a look and a change: stat values do not tell them apart."""
    now = time.time_ns()
    monkeypatch.setattr(facts, "YOUNG", 60_000_000_000)
    monkeypatch.setattr(
        facts, "stat_of", lambda status, *_: (status.st_mode, status.st_ino, status.st_dev, status.st_size, now, now)
    )
    for _ in range(2):  # the first one in a copy notes that it wrote this folder
        assert cli.main(BUILD) == 0
    before = Path(path).read_bytes()
    assert saved(*BUILD) is not None
    Path(path).write_bytes(before[:-2] + b"x" + before[-1:])
    assert saved(*BUILD) is None
    Path(path).write_bytes(before)
    assert saved(*BUILD) is not None


def test_once_its_files_are_old_stat_values_tell(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    Path(URDF).touch()
    with monkeypatch.context() as patch:
        patch.setattr(facts, "YOUNG", 60_000_000_000)
        for _ in range(2):
            assert cli.main(BUILD) == 0
        with monkeypatch.context() as counted:
            counted.setattr(facts, "content_facts", compared := mock.Mock(side_effect=facts.content_facts))
            assert saved(*BUILD) is not None
            assert compared.called
    time.sleep(0.1)
    assert saved(*BUILD) is not None
    monkeypatch.setattr(facts, "content_facts", lambda content: pytest.fail("a content is read"))
    assert saved(*BUILD) is not None


# Files that are no records


FILES = [f"{DEPS}/{name}" for name in ("leg.robot", "urdfsync.toml.config")]


@pytest.mark.parametrize("file", FILES)
def test_a_damaged_record_counts_as_none(folder: Path, file: str) -> None:
    save(*BUILD)
    content, status = Path(file).read_bytes(), Path(file).stat()
    zeros = [content[: len(content) // 2] + b"\0" * (len(content) // 2)]
    for other in [*(content[:n] for n in (0, 5, 30, len(content) // 3)), *zeros, b"\xff\0\0"]:
        Path(file).write_bytes(other)
        os.utime(file, ns=(status.st_mtime_ns, status.st_mtime_ns))
        assert noop.answer(BUILD) is None
        assert cli.main(CHECK) == 0
        Path(file).write_bytes(content)
        os.utime(file, ns=(status.st_mtime_ns, status.st_mtime_ns))
    assert saved(*BUILD) is not None or cli.main(BUILD) == 0


def test_a_damaged_result_is_made_again(folder: Path) -> None:
    save(*BUILD)
    file, status = Path(DEPS, "leg.robot"), Path(DEPS, "leg.robot").stat()
    content = file.read_bytes()
    for end in (len(content) - 1, content.rindex(b"\0\0") + 40):
        file.write_bytes(content[:end])
        os.utime(file, ns=(status.st_mtime_ns, status.st_mtime_ns))
        assert cli.main(["build", "--format", "json"]) == 0


@pytest.mark.parametrize("file", FILES)
def test_a_copy_counts_as_none(folder: Path, file: str) -> None:
    save(*BUILD)
    shutil.copy2(file, "copy")
    Path("copy").replace(file)
    assert saved(*BUILD) is None, "such as one that somebody has committed"


def test_a_file_of_nothing_but_separators_is_no_record(folder: Path) -> None:
    save(*BUILD)
    with Path(DEPS, "leg.robot").open("r+b") as file:  # which git packs into some kilobytes
        file.truncate(0)
        file.truncate(20_000_000_000)
    assert saved(*BUILD) is None


@pytest.mark.parametrize("name", ["leg.robot", ".leg.robot.urdfsync-tmp", "urdfsync.toml.config", "leg.told"])
def test_no_link_is_followed_where_something_is_remembered(folder: Path, name: str) -> None:
    victim = folder.parent / "victim"
    victim.write_text("precious")
    Path(DEPS).mkdir(exist_ok=True)
    Path(DEPS, name).unlink(missing_ok=True)
    Path(DEPS, name).symlink_to(victim)
    save(*BUILD)
    assert victim.read_text() == "precious"


def test_a_linked_folder_gets_no_record(folder: Path) -> None:
    elsewhere = folder.parent / "elsewhere"
    elsewhere.mkdir()
    Path(DEPS).symlink_to(elsewhere)
    time.sleep(0.1)
    assert cli.main(BUILD) == 0
    assert list(elsewhere.iterdir()) == []


@pytest.mark.posix("`st_ctime` is no change time there; tests/common/test_system.py has the same for it")
def test_nothing_is_remembered_where_the_time_of_a_change_can_be_set(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    time.sleep(0.1)  # so that it would be remembered
    with monkeypatch.context() as patch:
        patch.setattr(os, "lstat", lambda path, original=os.lstat: _as_on_fat(original(path)))
        assert cli.main(BUILD) == 0
        assert not Path(DEPS, "leg.robot").exists()
    save(*BUILD)


def _as_on_fat(status: os.stat_result) -> os.stat_result:
    """The time of change of status is that of content."""
    times = {"st_mtime_ns": status.st_mtime_ns, "st_ctime_ns": status.st_mtime_ns, "st_atime_ns": status.st_atime_ns}
    return os.stat_result(tuple(status), times)


def test_a_record_that_can_not_be_saved_is_no_error(folder: Path, capsys: Capture) -> None:
    Path(DEPS, "leg.robot").mkdir(parents=True)
    time.sleep(0.1)  # so that it would be remembered
    assert cli.main(BUILD) == 0
    assert capsys.readouterr().out == f"{IN_STEP}\n"


# A record and a plan agree, whatever happens to the files


PATHS = (
    *(URDF, LEG, "urdfsync.toml", "robots/leg_meshes/base.stl", "robots/arm_meshes/base.stl", "own/link.mo.jinja"),
    *("modelica/Leg/package.order", "modelica/Leg/Links/Tip/package.mo", "modelica/Lab/package.mo"),
    *(".urdfsync/robots/leg.state", ".urdfsync/notes/leg.json"),
    *("ros/a/package.xml", "ros/group/arm_meshes/package.xml"),
)
CHANGES = st.tuples(
    st.sampled_from(PATHS),
    st.sampled_from(["first", "first", "other", "longer", "absent"]),
    st.sampled_from(["write", "replace", "link", "mode"]),
    st.booleans(),
)
"""A path, what is there then, how it gets there, and whether its times stay what they were first."""
STEPS = st.lists(st.one_of(CHANGES, st.sampled_from([BUILD, CHECK, STATUS, "rest"])), min_size=4, max_size=12)


@pytest.mark.slow
@often(6)
@given(STEPS)
def test_record_and_plan_agree(
    in_step: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch, steps: list[object]
) -> None:
    place = tmp_path_factory.mktemp("site") / "project"
    shutil.copytree(in_step, place)
    (place / ".urdfsync/robots/gone.state").unlink()
    first = {path: _state(place / path) for path in PATHS}
    with monkeypatch.context() as patch:
        patch.chdir(place)
        assert cli.main(BUILD) == 0  # the first one in a copy notes what it tells
        save(*CHECK)
        for step in steps:
            if isinstance(step, list):
                cli.main(step)
            elif isinstance(step, tuple):
                path, what, how, old = step
                _bring(place / path, what, how, old, first[path])
            else:
                time.sleep(0.06)  # long enough for the files to be old
            lines = saved(*CHECK)
            with _nothing_remembered():
                planned = _document()
                assert lines is None or (0, "".join(f"{robot}: {words}\n" for robot, words, *_ in lines)) == _output(
                    CHECK
                )
            assert _document() == planned, step


@contextlib.contextmanager
def _nothing_remembered() -> Iterator[None]:
    with (
        mock.patch.object(RobotMemory, "recall", return_value=None),
        mock.patch.object(RobotMemory, "remember"),
    ):
        yield


def _output(command: list[str]) -> tuple[int, str]:
    """The exit code of a command, and what goes to the standard output."""
    output, errors = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        code = cli.main(command)
    output.flush()
    return code, output.buffer.getvalue().decode()


def _document() -> object:
    code, text = _output([*CHECK, "--format", "json"])
    return code, json.loads(text)


State = tuple[bytes, os.stat_result] | None


def _state(path: Path) -> State:
    return (path.read_bytes(), path.stat()) if path.is_file() else None


def _bring(path: Path, what: str, how: str, old: bool, first: State) -> None:
    if what == "absent" or (what == "first" and first is None):
        path.unlink(missing_ok=True)
        return
    content = first[0] if first else b"new"
    if what != "first":
        content = content[:-2] + b"x" + content[-1:] * (2 if what == "longer" else 1)
    path.parent.mkdir(parents=True, exist_ok=True)
    if how == "mode" and path.is_file():
        path.chmod(path.stat().st_mode ^ 0o010)
    elif how == "write":
        path.write_bytes(content)
    else:
        other = path.with_name(f"{path.name}.new")
        other.write_bytes(content)
        if how == "link":
            path.unlink(missing_ok=True)
            path.symlink_to(other)
        else:
            other.replace(path)
    if old and first:
        os.utime(path, ns=(first[1].st_atime_ns, first[1].st_mtime_ns))


# The whole program


def imported(*arguments: str) -> tuple[set[str], str]:
    """What Python imports, and what it prints."""
    variables = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[2])}
    command = [sys.executable, "-X", "importtime", *arguments]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    lines = [line for line in done.stderr.splitlines() if line.startswith("import time:")]
    return {line.rpartition("|")[2].strip() for line in lines}, done.stdout


@pytest.mark.slow
def test_nothing_heavy_is_imported(folder: Path) -> None:
    time.sleep(2.1)  # the copy is young for two seconds
    imported("-c", FULL, *BUILD)  # by the whole program, which notes something
    time.sleep(2.1)
    imported("-m", "urdfsync", *BUILD)  # all files are old from now on
    anyway, _ = imported("-c", "import runpy")
    names = imported("-m", "urdfsync", *BUILD)
    assert names[1] == f"{IN_STEP}\n"
    ours = {f"urdfsync.common.dependencies.{name}" for name in ("facts", "localfile", "places", "program", "memory")}
    ours |= {
        "urdfsync",
        "urdfsync.common",
        "urdfsync.common.noop",
        "urdfsync.common.dependencies",
        "urdfsync.common.streams",
        "urdfsync.common.version",
    }
    light = {"__future__", "atexit", "errno", "gc", "runpy", "time"}
    assert names[0] - anyway <= ours | light


def test_a_build_that_remembers_nothing_and_has_nothing_to_do_imports_no_library(folder: Path) -> None:
    imported("-c", FULL, *BUILD)  # the first one in a copy notes which program wrote this folder
    shutil.rmtree(DEPS)
    names, said = imported("-c", FULL, *BUILD)
    assert said == f"{IN_STEP}\n"
    assert not names & {"jinja2", "rich", "lxml", "numpy", "yourdfpy"}


def test_a_changed_number_makes_one_package_and_looks_at_no_class_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(write_workspace(tmp_path / "place", 1, 2))
    assert cli.main(["build", "-q"]) == 0
    Path("robot0.urdf").write_text(Path("robot0.urdf").read_text().replace('mass value="1"', 'mass value="2"', 1))
    monkeypatch.setattr(last_build, "generate", mock.Mock(side_effect=AssertionError))
    monkeypatch.setattr(PackageFiles, "has_class", mock.Mock(side_effect=AssertionError))
    assert cli.main(["build", "-q"]) == 0


def test_a_changed_number_of_a_package_that_nobody_edited_imports_no_parser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(write_workspace(tmp_path / "place", 1, 2))
    assert cli.main(["build", "-q"]) == 0
    Path("robot0.urdf").write_text(Path("robot0.urdf").read_text().replace('mass value="1"', 'mass value="2"', 1))
    names, said = imported("-c", FULL, *BUILD)
    assert "1 file written" in said
    assert not {name for name in names if name.startswith("urdfsync.merge")} | names & {"jinja2.ext", "subprocess"}
    ours = {f"urdfsync.modelica.{name}" for name in ("files", "identifiers", "literals", "markers", "names", "stamp")}
    assert {name for name in names if name.startswith("urdfsync.modelica.")} == ours


def test_python_looks_for_no_garbage_at_its_start_and_end() -> None:
    last = "import atexit, gc; atexit.register(lambda: print(gc.get_threshold()[0], gc.get_freeze_count() > 0))"
    _, said = imported("-c", f"{last}; from urdfsync.__main__ import main; main()", "--version")
    assert said.endswith("1000000 True\n")


FULL = "import sys; from urdfsync.commands.cli import main; sys.exit(main())"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
@pytest.mark.parametrize("variables", [{}, {"NO_COLOR": "1"}])
def test_it_looks_the_same_on_a_terminal(folder: Path, variables: dict[str, str]) -> None:
    full = f"from urdfsync.output import console; console.BAR_AFTER = 1e9; {FULL}"  # no bar on a busy machine
    time.sleep(2.1)
    _on_terminal(full, variables)  # what it says in full, the next ones count
    said = {_on_terminal(full, variables), _on_terminal(full, variables)}
    short = "import sys; from urdfsync.__main__ import main; main(); assert 'argparse' not in sys.modules"
    said.add(_on_terminal(short, variables))
    (same,) = said
    assert ("\x1b[" in same) is not bool(variables)
    assert "✓ " in same


def _on_terminal(code: str, variables: dict[str, str]) -> str:
    paths = {"PYTHONPATH": str(Path(cli.__file__).parents[2]), "TERM": "xterm", "PYTHONUTF8": "1"}
    code_of, said = print_on_terminal([sys.executable, "-c", code, *BUILD], {**paths, **variables})
    assert code_of == 0, said
    return said
