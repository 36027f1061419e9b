"""The stamp: says again what a command has said, as long as the command would say so."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support import stamps
from support.stamps import repeated, stamped

from urdfsync import cli, dependencies, streams
from urdfsync.checking import afterbuild
from urdfsync.output import console
from urdfsync.stamping import beside, making, stamp, trust

Capture = pytest.CaptureFixture[str]
Edit = Callable[[Path], object]

BUILD, CHECK, STATUS = ["build"], ["build", "--check"], ["status"]
STAMP = ".urdfsync/stamp"
LEG = "modelica/Leg/Links/Tip.mo"
URDF = "robots/leg.urdf"
IN_STEP = "arm: in step, 17 files, 1 kept because you edited it\nleg: in step, 16 files, 1 kept because you edited it"


SHARING = [True, False] if hasattr(os, "fork") else [False]
"""Whether a second process looks at half of the files."""


def share(monkeypatch: pytest.MonkeyPatch, whether: bool) -> None:
    monkeypatch.setattr(stamp, "_MANY", 0 if whether else sys.maxsize)
    monkeypatch.setattr(beside, "_may_fork", lambda: True)


def both_ways(monkeypatch: pytest.MonkeyPatch, *command: str) -> list[str] | None:
    """What the stamp answers, whether a second process helps or not."""
    answers = []
    for whether in SHARING:
        with monkeypatch.context() as patch:
            share(patch, whether)
            answers.append(repeated(*command))
    assert answers[0] == answers[-1]
    return answers[0]


@pytest.fixture
def folder(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project in step, which is the working folder; no command has left a stamp in it."""
    place = tmp_path / "project"
    shutil.copytree(in_step, place)
    (place / STAMP).unlink(missing_ok=True)
    stamps.program(tmp_path, monkeypatch)
    monkeypatch.chdir(place)
    return place


# What is said again


@pytest.mark.parametrize(
    "command",
    [BUILD, CHECK, STATUS, ["build", "leg"], ["build", "-q"], ["build", "--check", "--json"], ["status", "-v"]],
)
def test_what_was_said_is_said_again(folder: Path, command: list[str], capsys: Capture) -> None:
    stamped(*command)
    capsys.readouterr()
    assert cli.main(command) == 0
    said = capsys.readouterr()
    assert stamp.repeat(command) == 0
    assert capsys.readouterr() == said
    assert "stray-state" in said.out + said.err or command[-1] == "-q"


def test_commands_share_a_stamp(folder: Path) -> None:
    for command in (BUILD, CHECK, STATUS):
        stamped(*command)
    assert all(repeated(*command) is not None for command in (BUILD, CHECK, STATUS))


def test_a_check_says_nothing_of_a_build(folder: Path) -> None:
    shutil.rmtree(".urdfsync/base")  # a clone: what its files are merged with is not there yet
    stamped(*CHECK)
    assert repeated(*BUILD) is None


def test_the_answer_belongs_to_the_folder_and_the_environment(
    folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    stamped(*BUILD)
    with monkeypatch.context() as patch:
        patch.chdir("robots")
        assert repeated(*BUILD) is None, "paths look different from here"
    with monkeypatch.context() as patch:
        patch.setenv("ROS_PACKAGE_PATH", str(folder))
        assert repeated(*BUILD) is None
    with monkeypatch.context() as patch:
        patch.setenv("MODELICAPATH", str(folder))
        assert repeated(*BUILD) is None
    assert repeated(*BUILD) is not None


def test_a_configuration_that_is_named(folder: Path) -> None:
    Path("urdfsync.toml").rename("robots.toml")
    stamped("build", "--config", "robots.toml")
    assert repeated("build", "--config=./robots.toml") is None, "another command, as far as anybody knows"
    stamped("build", "--config=./robots.toml")


@pytest.mark.parametrize("command", [["build", "--full"], ["build", "--svg"], ["diff"], ["build", "--check", "nobody"]])
def test_what_is_not_said_again(folder: Path, command: list[str], capsys: Capture) -> None:
    time.sleep(0.1)
    cli.main(command)
    assert repeated(*command) is None


def test_a_build_that_wrote_leaves_no_stamp(folder: Path) -> None:
    time.sleep(0.1)
    Path(LEG).unlink()
    assert cli.main(BUILD) == 0
    assert repeated(*BUILD) is None
    stamped(*BUILD)


def test_builds_with_checks_are_not_said_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(afterbuild, "checked", lambda config, request, results: results)
    Path("urdfsync.toml").write_text('[defaults]\non_build = "check"\n' + Path("urdfsync.toml").read_text()[11:])
    assert cli.main(BUILD) == 0
    time.sleep(0.1)
    assert cli.main(BUILD) == 0
    assert repeated(*BUILD) is None
    stamped(*CHECK)


# What a stamp rests on


def _rewrite(path: str) -> Edit:
    """Another content of the same size, with the same time of change."""

    def edit(folder: Path) -> None:
        file = folder / path
        content, status = file.read_bytes(), file.stat()
        file.write_bytes(content[:-2] + b"x" + content[-1:])
        os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))
        assert file.stat().st_mtime_ns == status.st_mtime_ns
        assert file.stat().st_size == status.st_size

    return edit


def _replace(path: str) -> Edit:
    """The same content and times, in another file."""

    def edit(folder: Path) -> None:
        shutil.copy2(folder / path, folder / "other")
        (folder / "other").replace(folder / path)

    return edit


def _write(path: str, text: str = "") -> Edit:
    def edit(folder: Path) -> None:
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)

    return edit


def _delete(path: str) -> Edit:
    return lambda folder: (folder / path).unlink()


def _link(path: str) -> Edit:
    def edit(folder: Path) -> None:
        (folder / path).rename(folder / "moved")
        (folder / path).symlink_to(folder / "moved")

    return edit


EDITS: dict[str, Edit] = {
    **{
        f"{name} {path}": edit(path)
        for path in (URDF, LEG)
        for name, edit in (("rewrite", _rewrite), ("replace", _replace), ("delete", _delete), ("link", _link))
    },
    **{
        f"rewrite {path}": _rewrite(path)
        for path in (
            *("urdfsync.toml", "robots/leg_meshes/base.stl", ".urdfsync/robots/leg.json"),
            *(".urdfsync/robots/gone.toml", "modelica/Leg/package.order"),
        )
    },
    "a mesh that is better placed": _write("robots/arm_meshes/base.stl", stamps.TETRAHEDRON),
    "a package that hides another": _write("ros/a/package.xml", "<name>arm_meshes</name>"),
    "a folder to be ignored": _write("ros/group/COLCON_IGNORE"),
    "a template": _write("own/link.mo.jinja", "<< this >>"),
    "a folder of templates": _write("own/notes/deep/readme.txt"),
    "a parent that is gone": _delete("modelica/Lab/package.mo"),
    "a parent's single file": _write("modelica/Lab.mo"),
    "a package above all": _write("modelica/package.mo"),
    "a class that is a folder": lambda folder: (folder / LEG).rename(folder / "modelica/Leg/Links/package2.mo"),
    "a folder that is a class": _delete("modelica/Lab/Arm/Links/Base/package.mo"),
    "another stray state": _write(".urdfsync/robots/other.toml"),
    "bases that are lost": _delete(".urdfsync/base/leg.json.gz"),
    "an interrupted build": _write(".urdfsync/journal/apply.json"),
    "a file that may not be read": lambda folder: (folder / URDF).chmod(0),
    "a linked folder": _link("modelica/Leg"),
    "a search path that comes": _write("later/src/leg_meshes/package.xml", "<name>leg_meshes</name>"),
    "a folder that may be read at last": lambda folder: (folder / "ros/closed").chmod(0o700),
    "a mark of a package, by a link": lambda folder: (folder / "target").rmdir(),
}


@pytest.mark.parametrize("name", EDITS)
def test_whatever_matters_ends_a_stamp(folder: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(folder / "later"))
    (folder / "ros/closed").mkdir(mode=0)
    (folder / "ros/marked").mkdir()
    (folder / "target").mkdir()
    (folder / "ros/marked/package.xml").symlink_to(folder / "target")
    stamped(*BUILD)
    assert both_ways(monkeypatch, *BUILD) is not None
    EDITS[name](folder)
    assert both_ways(monkeypatch, *BUILD) is None


def test_so_does_a_library_that_comes_to_modelicapath(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MODELICAPATH", str(folder / "libraries"))
    source = Path(URDF).read_text()
    assert "package://leg_meshes/" in source
    Path(URDF).write_text(source.replace("package://leg_meshes/", "modelica://LegMeshes/"))
    stamped(*BUILD)
    assert both_ways(monkeypatch, *BUILD) is not None
    _write("libraries/LegMeshes 2.0/package.mo")(folder)
    assert both_ways(monkeypatch, *BUILD) is None


def test_so_does_another_program(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stamped(*BUILD)
    with monkeypatch.context() as patch:
        patch.setattr(stamp, "__version__", "0.0.1")
        assert repeated(*BUILD) is None
    with monkeypatch.context() as patch:
        patch.setattr(os, "geteuid", lambda: 12345, raising=False)
        assert repeated(*BUILD) is None, "another user may not be allowed to read all that"
    with monkeypatch.context() as patch:
        patch.setattr(os, "getgroups", lambda: [12345], raising=False)
        assert repeated(*BUILD) is None, "nor one of other groups"
    _rewrite("program.py")(tmp_path)
    assert repeated(*BUILD) is None, "a version that is being worked on"


def test_what_does_not_matter_does_not_end_it(folder: Path) -> None:
    stamped(*BUILD)
    for path in ("notes.txt", "modelica/notes.txt", "modelica/Leg/Own.mo", "robots/other.urdf", ".urdfsync/own.txt"):
        _write(path)(folder)
    assert repeated(*BUILD) is not None


FILES = st.lists(st.tuples(st.sampled_from(["a", "b", "a/deep"]), st.booleans()), min_size=1, max_size=8)
"""Folders of files; whether a file is seen as the target of a link."""


@given(st.data(), FILES)
@settings(max_examples=20)
def test_every_file_counts_whoever_looks_at_it(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, files: list[tuple[str, bool]]
) -> None:
    site = tmp_path_factory.mktemp("site")
    for folder in ("a/deep", "b"):
        (site / folder).mkdir(parents=True)
    paths = [site / folder / f"{number}.mo" for number, (folder, _) in enumerate(files)]
    for path in paths:
        path.write_text("1")
    groups: tuple[list[Path], list[Path]] = [], []
    for path, (_, is_target) in zip(paths, files, strict=True):
        groups[is_target].append(path)
    reading = _reading(site, *groups)
    with pytest.MonkeyPatch.context() as patch:
        for whether in SHARING:
            share(patch, whether)
            assert reading.holds()
        data.draw(st.sampled_from(paths)).write_text("22")
        for whether in SHARING:
            share(patch, whether)
            assert not reading.holds()


def _reading(site: Path, own: list[Path], targets: list[Path]) -> stamp.Reading:
    """A stamp that rests on these files, and on four other places."""
    contents: list[dict[str, stamp.Facts]] = [
        {str(path): dependencies.stat_of(path.stat()) for path in paths} for paths in (own, targets)
    ]
    kinds: dict[str, stamp.Facts] = {str(site): (0o040000,), str(site / "none"): (0,)}
    made = stamp.Stamp("program", (contents[0], contents[1]), (kinds, kinds), {})
    return stamp.Reading(made.dumps(1, 2), 1, 2)


def test_two_processes_share_the_work(tmp_path: Path) -> None:
    """By the number of paths: folders may differ much."""
    for number in range(20):
        (tmp_path / f"{number}.mo").touch()
    reading = _reading(tmp_path, paths := sorted(tmp_path.iterdir()), [])
    first, second = reading._halves
    assert [half[0].count("\0") for half in (first, second)] == [12, 8], "four more go with the second"
    assert reading.own == [str(path) for path in paths]


# When a stamp is trusted


def test_what_is_written_at_the_same_time_is_not_believed(folder: Path) -> None:
    stamped(*BUILD)
    Path(STAMP).unlink()
    for written in (True, False):
        time.sleep(0.1)  # what was before is old enough
        begin = time.monotonic_ns(), time.time_ns()
        with dependencies.record_dependencies() as looks:
            dependencies.read_file(folder / "urdfsync.toml")
            if written:
                Path(URDF).write_bytes(Path(URDF).read_bytes())
            dependencies.read_file(folder / URDF)
        making.keep(str(folder / "urdfsync.toml"), {"question": []}, looks, begin)
        assert Path(STAMP).exists() is not written


@pytest.mark.parametrize(
    ("age", "facts", "settled"),
    [
        (0.04, {}, False),
        (0.06, {}, True),
        (1.9, {"second": True}, False),
        (2.1, {"second": True}, True),
        (59, {"device": 2}, False),
        (61, {"device": 2}, True),
        (-10, {}, False),
        (-10, {"altered": 0.06}, True),
        (-10, {"altered": 61, "device": 2}, False),
        (100, {"altered": 0}, False),
        (100, {"altered": 0.01}, False),
    ],
)
def test_only_what_is_older_than_the_command_is_believed(age: float, facts: dict[str, float], settled: bool) -> None:
    now, passed, tick = 5_000_000_000_000_000_123, 3_000_000_000, 1_000_000_000
    changed = now - passed - int(age * tick)
    if facts.get("second"):
        changed -= changed % tick - tick  # a clock that counts seconds
    altered = (
        changed if "altered" not in facts else (now - passed - int(facts["altered"] * tick)) * bool(facts["altered"])
    )
    seen = (0o100644, 7, int(facts.get("device", 1)), 10, changed, altered)
    status = os.stat_result((0o100644, 8, 1, 1, 0, 0, 0, 0, 0, 0), {"st_mtime_ns": now, "st_dev": 1})
    assert trust.Clock(status, is_sound=True).trusts(seen, passed) is settled
    assert not trust.Clock(status, is_sound=False).trusts(seen, passed)


# What is no stamp


def test_a_damaged_stamp_is_none(folder: Path) -> None:
    stamped(*BUILD)
    content, status = Path(STAMP).read_bytes(), Path(STAMP).stat()
    damaged = [content[:length] for length in (0, 5, 30, len(content) // 2, len(content) - 1)]
    damaged += [content[:n] + bytes([content[n] ^ 1]) + content[n + 1 :] for n in range(0, len(content), 501)]
    for other in [*damaged, content + b"x"]:
        Path(STAMP).write_bytes(other)
        os.utime(STAMP, ns=(status.st_mtime_ns, status.st_mtime_ns))
        assert repeated(*BUILD) is None
        assert stamp.repeat(BUILD) is None
    Path(STAMP).write_bytes(content)
    os.utime(STAMP, ns=(status.st_mtime_ns, status.st_mtime_ns))
    assert repeated(*BUILD) is not None, "nothing else was wrong"


def test_a_copy_of_a_stamp_is_none(folder: Path) -> None:
    stamped(*BUILD)
    shutil.copy2(STAMP, "copy")
    Path("copy").replace(STAMP)
    assert repeated(*BUILD) is None, "such as one that somebody has committed"


def test_a_pipe_in_its_place_is_none(folder: Path) -> None:
    os.mkfifo(STAMP)
    assert repeated(*BUILD) is None, "nobody waits for it"


def test_there_is_none_where_nobody_knows_when_a_file_changed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    time.sleep(0.1)  # so that it would be written
    with monkeypatch.context() as patch:
        patch.setattr(trust, "HAS_CHANGE_TIMES", False)
        assert cli.main(BUILD) == 0
        assert not Path(STAMP).exists()
    with monkeypatch.context() as patch:
        patch.setattr(os, "fstat", lambda descriptor, original=os.fstat: _as_on_fat(original(descriptor)))
        assert cli.main(BUILD) == 0
        assert not Path(STAMP).exists()
    stamped(*BUILD)


def _as_on_fat(status: os.stat_result) -> os.stat_result:
    """The time of change of status is that of content."""
    times = {"st_mtime_ns": status.st_mtime_ns, "st_ctime_ns": status.st_mtime_ns, "st_atime_ns": status.st_atime_ns}
    return os.stat_result(tuple(status), times)


def test_a_progress_bar_is_not_said_again(folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(console, "_BAR_AFTER", 0.0)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    stamped(*BUILD)
    assert "━" in capsys.readouterr().err, "there was one"
    assert stamp.repeat(BUILD) == 0
    said = capsys.readouterr()
    assert "━" not in said.err
    assert said.out.count("in step") == 2


def test_a_stamp_that_can_not_be_written_is_no_error(folder: Path, capsys: Capture) -> None:
    Path(STAMP).mkdir()
    time.sleep(0.1)  # so that it would be written
    assert cli.main(BUILD) == 0
    assert capsys.readouterr().out == f"{IN_STEP}\n"
    assert sorted(path.name for path in Path(".urdfsync").iterdir() if path.name.startswith(".")) == [".gitignore"]


# Stamp and decision agree, whatever happens to the files


PATHS = (
    *(URDF, LEG, "urdfsync.toml", "robots/leg_meshes/base.stl", "robots/arm_meshes/base.stl", "own/link.mo.jinja"),
    *("modelica/Leg/package.order", "modelica/Leg/Links/Tip/package.mo", "modelica/Lab/package.mo"),
    *(
        ".urdfsync/robots/leg.json",
        ".urdfsync/robots/leg.toml",
        ".urdfsync/robots/gone.toml",
        ".urdfsync/base/leg.json.gz",
    ),
    *("ros/a/package.xml", "ros/group/arm_meshes/package.xml", ".urdfsync/journal/prepare.json"),
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
@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(STEPS)
def test_stamp_and_decision_agree(
    in_step: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch, steps: list[object]
) -> None:
    """About 15 s of CPU."""
    site = tmp_path_factory.mktemp("site")
    place = site / "project"
    shutil.copytree(in_step, place)
    first = {path: _state(place / path) for path in PATHS}
    with monkeypatch.context() as patch:
        patch.chdir(place)
        stamps.program(site, patch)
        stamped(*CHECK)
        for step in steps:
            if isinstance(step, list):
                cli.main(step)
            elif isinstance(step, tuple):
                path, what, how, old = step
                _bring(place / path, what, how, old, first[path])
            else:
                time.sleep(0.06)  # long enough for the next stamp
            for command in (BUILD, CHECK, STATUS):
                said = both_ways(monkeypatch, *command)
                assert said is None or said == _full(command), (command, step)


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


def _full(command: list[str]) -> list[str] | None:
    """What the command says if it is carried out, in the form of a stamp; None unless it succeeds."""
    said: streams.Said = []
    with streams.guarded(said):
        code = cli._main(command)
    return [text for pair in said if pair[1] for text in pair] if code == 0 else None


# The whole program


def imported(*arguments: str, code: int = 0) -> tuple[set[str], str]:
    """What Python imports, and what it prints."""
    variables = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[1])}
    command = [sys.executable, "-X", "importtime", *arguments]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    lines = [line for line in done.stderr.splitlines() if line.startswith("import time:")]
    return {line.rpartition("|")[2].strip() for line in lines}, done.stdout


def test_nothing_heavy_is_imported(folder: Path) -> None:
    end = time.monotonic() + stamps.LIMIT
    anyway, _ = imported("-c", "import runpy")
    while "urdfsync.cli" in (names := imported("-m", "urdfsync", *BUILD))[0]:
        assert time.monotonic() < end, "no stamp"
    assert names[1] == f"{IN_STEP}\n"
    ours = {"urdfsync", "urdfsync.program", "urdfsync.stamping", "urdfsync.stamping.stamp", "urdfsync.streams"}
    assert names[0] - anyway - ours <= {"atexit", "gc", "zlib", "runpy"}


TWO = """
import os, sys
from urdfsync.stamping import beside, stamp
from urdfsync.__main__ import main
beside._may_fork, stamp._MANY, fork, made = lambda: True, 0, os.fork, []
os.fork = lambda: made.append(process := fork()) or process
code = main()
assert made and "argparse" not in sys.modules
sys.exit(code)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs a second process")
def test_two_processes_speak_once(folder: Path) -> None:
    stamped_program(CHECK)
    said = []
    for code in (TWO, FULL):
        with started(code, CHECK, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            said.append(process.communicate())
        assert process.returncode == 0
    assert said[0] == said[1]
    assert said[0][0] == f"{IN_STEP}\n".encode()


FULL = "import sys; from urdfsync.cli import main; sys.exit(main())"
SHORT = "import sys; from urdfsync.__main__ import main; sys.exit(main())"


def started(code: str, command: list[str], **options: Any) -> subprocess.Popen[bytes]:
    variables = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[1]), **options.pop("env", {})}
    return subprocess.Popen([sys.executable, "-c", code, *command], env=variables, **options)


def stamped_program(command: list[str]) -> None:
    """Let the whole program run until it has left a stamp."""
    end = time.monotonic() + stamps.LIMIT
    while not Path(STAMP).exists():
        with started(FULL, command, stdout=subprocess.PIPE) as process:
            process.communicate()
        assert time.monotonic() < end, "no stamp"


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
@pytest.mark.parametrize("variables", [{}, {"NO_COLOR": "1"}])
def test_it_looks_the_same_on_a_terminal(folder: Path, variables: dict[str, str]) -> None:
    said = {_on_terminal(FULL, variables)}
    end = time.monotonic() + stamps.LIMIT
    while not Path(STAMP).exists():
        said.add(_on_terminal(FULL, variables))
        assert time.monotonic() < end, "no stamp"
    said.add(_on_terminal(SHORT.replace("sys.exit(main())", "main(); assert 'argparse' not in sys.modules"), variables))
    (same,) = said
    assert (b"\x1b[" in same) is not bool(variables)
    assert "✓ ".encode() in same


def _on_terminal(code: str, variables: dict[str, str]) -> bytes:
    import pty

    master, slave = pty.openpty()
    variables = {"TERM": "xterm", "PYTHONUTF8": "1", **variables}
    with started(code, BUILD, stdin=slave, stdout=slave, stderr=slave, env=variables) as process:
        os.close(slave)
        said = b""
        while block := _read(master):
            said += block
    os.close(master)
    assert process.returncode == 0, said
    return said


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, 4096)
    except OSError:  # the other end is closed
        return b""


def _with_full_disk(code: str) -> tuple[int, bytes]:
    with Path("/dev/full").open("wb") as sink, started(code, CHECK, stdout=sink, stderr=subprocess.PIPE) as process:
        _, said = process.communicate()
    return process.returncode, said


def _without_reader(code: str) -> tuple[int, bytes]:
    source, sink = os.pipe()
    os.close(source)
    with started(code, CHECK, stdout=sink, stderr=subprocess.PIPE) as process:
        os.close(sink)
        _, said = process.communicate()
    return process.returncode, said


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
@pytest.mark.parametrize("ending", [_with_full_disk, _without_reader])
def test_an_output_that_ends_early(folder: Path, ending: Callable[[str], tuple[int, bytes]]) -> None:
    whole = ending(FULL)
    stamped_program(CHECK)
    assert ending(SHORT) == whole
    assert whole[0] == (2 if ending is _with_full_disk else 0)
