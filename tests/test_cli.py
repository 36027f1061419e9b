"""The commands as people and programs use them: output, exit codes, JSON."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from unittest import mock

import pytest
from support.commands import Execute
from support.networks import LADDER, ROBOT, configure, edit, source

from urdfsync import cli, config
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.result import Exit
from urdfsync.files import shown
from urdfsync.output.console import Console

Capture = pytest.CaptureFixture[str]

NEXT = [
    "",
    "What to do next:",
    f"  open {Path('modelica/Ladder/package.mo')} in OMEdit or Dymola",
    "  urdfsync library  prints how these tools find the library UrdfSync",
    "  urdfsync watch    builds whenever a source changes",
    "  urdfsync check    compiles the package",
]
"""What follows the first build of a package."""


@pytest.fixture
def edited(project: Path) -> Path:
    """A built project with one edited model."""
    cli.main(["build"])
    edit(f"{LADDER}/Ladder.mo", "end Ladder;\n", "end Ladder;\n// mine\n")
    return project


# build


def test_build_in_words(project: Path, execute: Execute) -> None:
    assert execute("build").lines == ["ladder: 14 files written", *NEXT]
    assert execute("build").out == "ladder: in step, 14 files\n"


def test_check_writes_nothing_and_exits_with_1_if_out_of_step(
    project: Path, execute: Execute, snapshot_of: Callable[[Path], object]
) -> None:
    before = snapshot_of(project)
    assert execute("build", "--check", code=1).out == "ladder: 14 files to write\n"
    assert snapshot_of(project) == before
    assert cli.main(["build", "--dry-run"]) == 0
    assert snapshot_of(project) == before
    cli.main(["build"])
    edit(f"{LADDER}/Ladder.mo", "end Ladder;\n", "end Ladder;\n// mine\n")
    assert cli.main(["build", "--check"]) == 0, "an edit is in step"


def test_explain_names_each_file_on_one_line(edited: Path, execute: Execute) -> None:
    (edited / "modelica/Ladder/Elements/R1.mo").unlink()
    lines = execute("build", "--explain", "--dry-run").lines
    assert lines[0] == "ladder: 1 to restore, 1 kept because you edited it"
    folder = Path("modelica/Ladder")
    assert f"  keep       {folder / 'Ladder.mo'}  you edited it; there is nothing new for it" in lines
    assert f"  restore    {folder / 'Elements' / 'R1.mo'}  you deleted it" in lines
    assert lines[-1] == "  12 unchanged files; --verbose names each"
    assert len(lines) == 4
    assert len(execute("build", "--explain", "--verbose", "--dry-run").lines) == 15


def test_findings_go_to_the_error_stream(project: Path, execute: Execute) -> None:
    source('"R2"', '"r2"')
    (project / "step.csv").unlink()
    streams = execute("build", code=2)
    assert streams.out == ""
    assert streams.err.splitlines() == [
        "ladder.json:8: error: 'r2' is no class name [element-name]",
        "ladder: 1 error, nothing was changed",
    ]


def test_robots_are_chosen_by_name(execute: Execute, project: Path) -> None:
    configure(ROBOT.format("other", "Other"))
    for arguments in (["build", "other"], ["build", "--robot", "other"]):
        assert execute(*arguments).out.startswith("other: ")
    message = "error: no robot `othr` in the configuration; did you mean `other`? [unknown-robot]"
    assert execute("build", "othr", code=2).err == f"urdfsync.toml: {message}\n"


def test_the_configuration_is_found_or_named(
    project: Path, tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    (project / "deep").mkdir()
    monkeypatch.chdir(project / "deep")
    assert cli.main(["build"]) == 0
    assert (project / "modelica/Ladder").is_dir()
    monkeypatch.chdir(tmp_path)
    execute("build", "--config", "project/urdfsync.toml")
    assert execute("build", code=2).err.startswith("error: no urdfsync.toml in ")
    os.mkfifo("urdfsync.toml")
    assert "the configuration can't be read: it is no regular file" in execute("build", code=2).err
    assert execute("build", "--config", "nothing.toml", code=2).err.startswith(
        "nothing.toml: error: the configuration does not exist"
    )


def test_ros_package_path_is_searched(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (project / "step.csv").rename(tmp_path / "step.csv")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    cli.main(["build"])
    assert (project / "modelica/Ladder/Resources/step.txt").exists()


def test_svg(execute: Execute, project: Path) -> None:
    drawing = Path(".urdfsync/svg/ladder.svg")
    assert execute("build", "--svg").lines == ["ladder: 14 files written", f"  diagram: {drawing}", *NEXT]
    assert drawing.exists()
    assert execute("build", "--svg").lines == ["ladder: in step, 14 files", f"  diagram: {drawing}"]


# other commands


@pytest.mark.parametrize(
    "arguments",
    [
        *([], ["biuld"], ["build", "--svg", "--check"], ["build", "--nothing"], ["build", "--dry"]),
        *(["status", "--dry-run"], ["status", "--wait", "soon"]),
    ],
)
def test_bad_usage(arguments: list[str], execute: Execute) -> None:
    """Options are spelled out, too."""
    usage = "usage: urdfsync build" if arguments[:1] == ["build"] else "usage: urdfsync"
    assert execute(*arguments, code=2).err.startswith(usage)


@pytest.mark.parametrize(
    "command", [["build"], ["adopt", "ladder"], ["remove", "ladder"], ["resolve", "--all", "--take"]]
)
def test_n_is_a_dry_run(
    edited: Path, execute: Execute, snapshot_of: Callable[[Path], object], command: list[str]
) -> None:
    source('"R2"', '"R3"')
    before = snapshot_of(edited)
    code, *printed = execute(*command, "--dry-run", code=None)
    assert execute(*command, "-n", code=code)[1:] == tuple(printed)
    assert snapshot_of(edited) == before
    assert any(printed)


def test_python_runs_it_as_a_module(project: Path) -> None:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-m", "urdfsync"]
    done = subprocess.run([*command, "build", "-n"], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "ladder: 14 files to write\n", "")
    helped = subprocess.run([*command, "--help"], env=environment, capture_output=True, text=True, check=True).stdout
    assert helped.startswith("usage: urdfsync ")
    assert "resolve" in helped


def test_what_was_meant_is_said(execute: Execute) -> None:
    meant = {("biuld",): "build", ("build", "--dryrun"): "--dry-run", ("resolve", "--al", "--keep"): "--all"}
    for arguments, name in meant.items():
        assert f"; did you mean `{name}`? [usage]" in execute(*arguments, code=2).err
    assert "; `urdfsync --help` says more [usage]" in execute("swim", code=2).err


def test_library(execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    (told,) = execute("library", "--json").json["results"]
    assert (Path(told["folder"]) / "UrdfSync").is_dir()
    assert execute("library").out == f"{told['line']}\n"
    screen = Terminal()
    monkeypatch.setattr(sys, "stdout", screen)
    assert cli.main(["library"]) == 0
    assert screen.getvalue() == f"{told['folder']}\n{told['line']}\n"


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
@pytest.mark.parametrize(
    ("name", "before", "after"), [("a'b\"c", "", ""), ("two $HOME `id` \\n", "/lib one:/two", ":/lib one:/two")]
)
def test_the_line_of_library_is_for_eval(
    tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, name: str, before: str, after: str
) -> None:
    monkeypatch.setattr(config, "library_folder", lambda: tmp_path / name)
    script = 'eval "$1"; printf %s "$MODELICAPATH"'
    command = ["bash", "-c", script, "bash", execute("library").out]
    environment = os.environ | {"MODELICAPATH": before}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == f"{tmp_path / name}{after}"


def test_a_working_folder_that_is_gone(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "getcwd", mock.Mock(side_effect=FileNotFoundError(2, "No such file or directory")))
    assert shown(project) == str(project)
    for command in ("build", "init"):
        message = "error: the working folder does not exist any more; change to a folder that exists [no-folder]\n"
        assert execute(command, code=2).err == message


# looks


class Terminal(io.StringIO):
    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize("variable", ["", "NO_COLOR", "TERM"])
def test_a_terminal_gets_colours_unless_it_wants_none(
    project: Path, monkeypatch: pytest.MonkeyPatch, variable: str
) -> None:
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setattr("urdfsync.output.console.BAR_AFTER", float("inf"))  # no bar, however slow the machine is
    if variable:
        monkeypatch.setenv(variable, "dumb")
    (project / "step.csv").unlink()
    for arguments in (["build", "--explain"], ["build"], ["build", "--full"], ["build", "nobody"]):
        screen, errors = Terminal(), Terminal()
        monkeypatch.setattr(sys, "stdout", screen)
        monkeypatch.setattr(sys, "stderr", errors)
        cli.main(arguments)
        assert ("\x1b" in screen.getvalue() + errors.getvalue()) is not bool(variable)
        assert "✓" in screen.getvalue() or arguments[-1] == "nobody"


EVIL = "a\x1b[31m\x07\u202eb\x9b2J\ud800"


def test_text_of_others_can_not_command_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "dumb")
    errors = Terminal()
    monkeypatch.setattr(sys, "stderr", errors)
    found = Diagnostic(Severity.ERROR, "x", f"it says `{EVIL}`", f"{EVIL}.urdf", 3, hint=f"not {EVIL}")
    Console().end(Exit.ERROR, [found])
    safe = "a\\x1b[31m\\x07\\u202eb\\x9b2J\\ud800"
    assert errors.getvalue() == f"{safe}.urdf:3: error: it says `{safe}`; not {safe} [x]\n"


def test_many_findings_of_one_kind_are_folded(capsys: Capture) -> None:
    many = [Diagnostic(Severity.WARNING, "mesh-not-found", f"mesh {n} not found", "a.urdf", n) for n in range(1, 10)]
    Console().end(Exit.ERROR, many)
    lines = capsys.readouterr().err.splitlines()
    assert lines[:4] == [f"a.urdf:{n}: warning: mesh {n} not found [mesh-not-found]" for n in range(1, 5)]
    assert lines[4:] == ["and 5 more like these [mesh-not-found]; --verbose shows them"]
    Console(verbose=True).end(Exit.ERROR, many)
    assert len(capsys.readouterr().err.splitlines()) == 9


def test_whatever_the_system_refuses_is_one_line(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    error = PermissionError(13, "Permission denied", "somewhere")
    monkeypatch.setattr(config, "load", mock.Mock(side_effect=error))
    assert execute("build", code=2).err == "somewhere: error: Permission denied [system]\n"


def test_conflict(edited: Path, execute: Execute) -> None:
    source('"R2"', '"R3"')
    model = Path("modelica/Ladder/Ladder.mo")
    for arguments in (["build", "--dry-run"], ["build", "--check"], ["build"], ["build", "--verbose"]):
        lines = execute(*arguments, code=3).lines
        assert lines[0] == "ladder: 1 conflict, 5 files wait until the conflict is resolved"
        assert f"  conflict   {model}  network" in lines
        shown = '    +  Elements.R3 elementR3 "Element R3";'
        assert (shown if "--verbose" in arguments else "    the export  component `elementR3`: added") in lines
        assert f"    urdfsync resolve {model} --merge" in lines
    assert execute("build", "--quiet", code=3).lines == [
        "ladder: 1 conflict, 5 files wait until the conflict is resolved",
        f"  conflict   {model}  the changes fit together: --merge takes both",
        "",
        "  urdfsync resolve --all --robot ladder --merge  merges it",
    ]
