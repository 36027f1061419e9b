"""What differs between the systems: programs, held and read-only files, times, streams, command lines, names."""

from __future__ import annotations

import io
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from support.commands import Execute
from support.files import fresh_models, models, unchanged
from support.git import NEEDS_GIT, Repository
from support.networks import LADDER, MODEL, RECORD, edit, resistor
from support.urdfs import robot_of

import urdfsync
from urdfsync.common import noop, system
from urdfsync.common.dependencies import facts
from urdfsync.common.files import failure
from urdfsync.common.streams import Stream
from urdfsync.project.state.lock import build_lock

PROGRAM = "git.exe" if system.IS_WINDOWS else "git"


def run(*words: str, **environment: str) -> subprocess.CompletedProcess[bytes]:
    """Run a command in a process of its own, without Python's UTF-8 mode."""
    variables = {name: value for name, value in os.environ.items() if name not in ("PYTHONUTF8", "PYTHONIOENCODING")}
    path = os.pathsep.join([str(Path(urdfsync.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    command = [sys.executable, "-m", "urdfsync", *words]
    return subprocess.run(command, env=variables | {"PYTHONPATH": path} | environment, capture_output=True, check=False)


# --- programs -------------------------------------------------------------------------------------------------------


@pytest.fixture
def stranger(project: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A program called git in the working folder, which a relative entry of the PATH names."""
    program = project / PROGRAM
    program.write_text(f"#!/bin/sh\ntouch {project}/ran\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", os.pathsep.join([".", "", os.environ["PATH"]]))
    return program


@pytest.mark.parametrize("words", [("merge-driver", "--install"), ("hook", "check"), ("diff", "--against", "HEAD")])
def test_a_program_of_the_working_folder_never_runs(stranger: Path, execute: Execute, words: tuple[str, ...]) -> None:
    (stranger.parent / ".git").mkdir()
    execute(*words, code=None)
    assert not (stranger.parent / "ran").exists()


def test_a_name_is_looked_for_on_the_path_alone_and_a_path_from_its_folder(stranger: Path, tmp_path: Path) -> None:
    found = system.find_program("git")
    assert found is None or (Path(found).is_absolute() and Path(found).parent != stranger.parent)
    assert system.find_program("git", path=str(stranger.parent)) == str(stranger)
    assert system.find_program(f".{os.sep}git", stranger.parent) == os.path.join(stranger.parent, ".", PROGRAM)  # noqa: PTH118
    assert system.find_program("git", path=f".{os.pathsep}{tmp_path}") is None
    with pytest.raises(FileNotFoundError):
        system.command(["urdfsync-has-no-such-program"])


def test_a_command_of_a_robot_is_found_on_the_path(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = Path(sys.executable).parent
    monkeypatch.setenv("PATH", str(folder), prepend=os.pathsep)
    name = Path(sys.executable).name
    script = "import shutil; shutil.copy('ladder.json', 'made.json')"
    edit("urdfsync.toml", 'source = "ladder.json"', f'source = "made.json"\ncommand = ["{name}", "-c", "{script}"]')
    (project / name).write_text("no program")
    execute("build", "--trust")
    assert Path(MODEL).exists()


# --- files that others hold -----------------------------------------------------------------------------------------


class HeldError(PermissionError):
    """The error of Windows for a file that another program holds."""

    winerror = 32
    strerror = "Sharing violation"


def test_a_held_file_is_waited_for_a_moment(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = list[str]()

    def rename(path: str) -> str:
        calls.append(path)
        if len(calls) < 3:
            raise HeldError
        return path

    assert system.patiently(lambda: rename("arm.mo")) == "arm.mo"
    assert len(calls) == 3
    monkeypatch.setattr(system, "PATIENCE", 0)
    calls.clear()
    with pytest.raises(HeldError):
        system.patiently(lambda: rename("arm.mo"))


def test_another_error_is_told_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time, "sleep", lambda _: pytest.fail("there is nothing to wait for"))
    with pytest.raises(FileNotFoundError):
        system.patiently(Path("missing").read_bytes)


def test_a_held_file_is_told_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system, "PATIENCE", 0)

    def rename() -> None:
        raise HeldError

    with pytest.raises(HeldError) as caught:
        system.patiently(rename)
    (finding,) = failure(caught.value, "arm.mo").diagnostics
    assert str(finding).startswith("arm.mo: error: it can't be written: another program has it open; close it there")


@pytest.mark.parametrize(("path", "words"), [
    ("ladder.json", ("status",)),
    ("ladder.json", ("init", "ladder.json", "--domain=rcnetwork", "--config=new.toml")),
    ("urdfsync.toml", ("build",)),
])  # fmt: skip
def test_a_held_input_is_told_in_the_same_words(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, path: str, words: tuple[str, ...]
) -> None:
    """A CAD program that still writes its export, or an editor, may hold a file."""
    monkeypatch.setattr(system, "PATIENCE", 0)
    opened = os.open

    def hold() -> None:
        raise HeldError

    def open_file(name: str | os.PathLike[str], *arguments: Any, **more: Any) -> int:
        if Path(name).name == path:
            system.patiently(hold)
        return opened(name, *arguments, **more)

    monkeypatch.setattr(os, "open", open_file)
    monkeypatch.setattr(system, "open_file", open_file)
    error = execute(*words, code=2).err
    assert "can't be read: another program has it open; close it there" in error


@pytest.mark.windows
@pytest.mark.parametrize("path", [RECORD, MODEL, ".urdfsync/robots/ladder.state"])
def test_a_build_that_meets_a_held_file_changes_nothing_and_the_next_one_finishes(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, path: str
) -> None:
    execute("build")
    monkeypatch.setattr(system, "PATIENCE", 0.2)
    resistor(220)
    edit("ladder.json", '"R2"', '"R3"')
    with Path(path).open("rb"):  # as an editor, a simulation or a virus scanner holds it: without sharing its deletion
        before = execute("status", code=1).out
        with unchanged(project, but=".urdfsync/lock"):
            error = execute("build", code=2).err
        assert path.replace("/", os.sep) in error
        assert "another program has it open" in error
        assert len(error.splitlines()) == 2
        assert execute("status", code=1).out == before
    execute("build")
    assert models() == fresh_models(project.parent / "fresh")
    execute("build", "--check")


@pytest.mark.windows
def test_a_file_that_is_held_for_a_moment_stops_no_build(project: Path, execute: Execute) -> None:
    execute("build")
    resistor(220)
    file = Path(RECORD).open("rb")  # noqa: SIM115 - a thread closes it
    threading.Timer(0.5, file.close).start()
    execute("build")
    assert "220" in Path(RECORD).read_text()


@pytest.mark.windows
def test_a_file_that_nobody_else_may_read_is_told(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    execute("build")
    monkeypatch.setattr(system, "PATIENCE", 0.1)
    resistor(220)
    script = f"""
import ctypes, sys
handle = ctypes.windll.kernel32.CreateFileW({str(Path(RECORD).absolute())!r}, 0x80000000, 0, None, 3, 0, None)
print(handle, flush=True); sys.stdin.read()
"""
    with subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
        assert holder.stdout
        assert holder.stdin
        assert int(holder.stdout.readline()) > 0
        error = execute("build", code=2).err
        assert "another program has it open" in error
        holder.stdin.close()
    execute("build")


def test_read_only_files_are_replaced_as_their_folder_allows(project: Path, execute: Execute) -> None:
    execute("build")
    for path in [*Path(LADDER).rglob("*"), *Path(".urdfsync/robots").rglob("*"), *Path(".urdfsync/bases").rglob("*")]:
        if path.is_file():
            path.chmod(stat.S_IREAD)
    resistor(220)
    edit("ladder.json", '"R2"', '"R3"')
    execute("build")
    assert "220" in Path(RECORD).read_text()
    assert not os.access(RECORD, os.W_OK) or not system.IS_WINDOWS, "its permissions stay"
    assert not list(project.rglob("*.urdfsync-tmp*"))
    execute("build", "--check")


def test_a_lock_of_an_ended_process_is_free_and_a_held_one_names_its_process(tmp_path: Path) -> None:
    script = f"""
import sys
from pathlib import Path
from typing import Any
from urdfsync.project.state.lock import build_lock
build_lock(Path({str(tmp_path / ".urdfsync")!r}), 5).acquire()
print(flush=True); sys.stdin.read()
"""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", script]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment) as holder:
        assert holder.stdout
        holder.stdout.readline()
        lock = build_lock(tmp_path / ".urdfsync", 0)
        with pytest.raises(urdfsync.common.diagnostics.UrdfsyncError) as caught:
            lock.acquire()
        assert f"process {holder.pid} is building here" in str(caught.value)
        holder.kill()  # as the task manager does
        holder.wait()
    lock = build_lock(tmp_path / ".urdfsync", 10)
    lock.acquire()
    lock.release()


# --- what is remembered ---------------------------------------------------------------------------------------------


@pytest.fixture
def built(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The source of a built robot."""
    monkeypatch.setattr(facts, "YOUNG", 50_000_000)  # else each test would wait for two seconds
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    Path("arm.urdf").write_text(robot_of("Tip 1"))
    execute("build")
    return folder / "arm.urdf"


def change(source: Path) -> None:
    """Change a file; its size and the time of its content stay."""
    status = source.stat()
    edit(source, 'mass value="1.0"', 'mass value="2.0"')
    os.utime(source, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert (source.stat().st_size, source.stat().st_mtime_ns) == (status.st_size, status.st_mtime_ns)


def test_a_build_without_work_is_remembered_until_a_change_that_keeps_size_and_time(
    built: Path, execute: Execute
) -> None:
    execute("build")
    assert noop.find_lines(["build"])
    time.sleep(0.1)
    assert noop.find_lines(["build"]), "now the record rests on times alone"
    assert noop.find_lines(["build"])
    change(built)
    assert noop.find_lines(["build"]) is None


@pytest.mark.windows
def test_without_change_times_contents_tell_a_change(
    built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(system, "change_time", lambda *_, **__: system.NO_TIME)
    execute("build")
    time.sleep(0.1)
    assert noop.find_lines(["build"])
    assert noop.find_lines(["build"])
    change(built)
    assert noop.find_lines(["build"]) is None


# --- streams and shells ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("encoding", ["cp1252", "cp850", "ascii", "utf-8"])
def test_a_pipe_gets_signs_that_its_encoding_has(built: Path, encoding: str) -> None:
    change(built)
    lines = run("diff", PYTHONIOENCODING=encoding).stdout.decode(encoding)
    assert f"1 {'→' if encoding == 'utf-8' else '->'} 2 kg" in lines
    assert "\\u" not in lines


@pytest.mark.windows
@pytest.mark.parametrize(("page", "content"), [(850, b"M\x81ller"), (65001, "Müller".encode()), (0, b"M\xfcller")])
def test_a_pipe_has_the_encoding_of_the_console(monkeypatch: pytest.MonkeyPatch, page: int, content: bytes) -> None:
    """PowerShell reads it so; Python itself takes that of Windows."""
    monkeypatch.setattr("urdfsync.common.system._kernel.GetConsoleOutputCP", lambda: page)
    monkeypatch.setattr("urdfsync.common.system._kernel.GetACP", lambda: 1252)
    pipe = io.BytesIO()
    inner = io.TextIOWrapper(pipe, encoding="cp1252", write_through=True)
    Stream(inner).write("Müller")
    assert pipe.getvalue() == content
    chosen = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    Stream(chosen)
    assert chosen.encoding == "utf-8"


def test_documents_and_scripts_have_the_same_bytes_everywhere(built: Path) -> None:
    change(built)
    documents = [
        run("diff", f"--format={name}", PYTHONIOENCODING="cp1252").stdout for name in ("markdown", "json", "sarif")
    ]
    assert "1 → 2 kg".encode() in documents[0]
    scripts = [run("completion", shell).stdout for shell in ("bash", "zsh", "fish", "powershell")]
    answers = [run("completion", "bash", "--", "buil").stdout, run("completion", "powershell", "--", ".buil").stdout]
    assert answers[0] == answers[1]
    assert answers[0].startswith(b"build\t")
    for text in (*documents, *scripts, *answers, run("library").stdout):
        assert text
        assert b"\r" not in text


def test_json_names_files_with_slashes(project: Path, execute: Execute) -> None:
    edit("urdfsync.toml", 'source = "ladder.json"', 'source = "export/ladder.json"')
    Path("export").mkdir()
    shutil.move("ladder.json", "export/ladder.json")
    execute("build")
    edit("export/ladder.json", '"ohm": 100}', '"ohm": }')
    document = execute("build", "--format=json", code=2).json
    assert document["results"][0]["diagnostics"][0]["file"] == "export/ladder.json"


def test_a_command_to_copy_has_quotes_where_powershell_needs_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system, "IS_WINDOWS", True)
    words = ["urdfsync", "simulate", "arm", "--set", "a={1}", "--model", "HEAD~1", "C:\\My arms", ""]
    assert system.join_words(words) == 'urdfsync simulate arm --set "a={1}" --model HEAD~1 "C:\\My arms" ""'


@pytest.mark.parametrize(("shell", "begin"), [
    ("sh", "export MODELICAPATH="), ("powershell", "$env:MODELICAPATH = '"), ("cmd", "if defined MODELICAPATH (set "),
])  # fmt: skip
def test_library_has_a_line_for_each_shell(execute: Execute, shell: str, begin: str) -> None:
    assert execute("library", "--shell", shell).out.startswith(begin)
    assert execute("library").out == execute("library", "--shell", "powershell" if system.IS_WINDOWS else "sh").out


# --- git that changes line ends -------------------------------------------------------------------------------------

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@NEEDS_GIT
def test_a_hook_judges_a_commit_in_its_clone(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    execute("build")
    repository = Repository(project, monkeypatch)
    repository.commit()
    execute("hook", "check")
    resistor(220)
    repository.git("add", "-A")
    assert "out of step" in execute("hook", "check", code=1).err
    execute("build")
    repository.git("add", "-A")
    execute("hook", "check")


@NEEDS_GIT
def test_a_clone_with_other_line_ends_is_in_step_and_keeps_its_state(
    tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As Git for Windows makes it: `core.autocrlf` is true there."""
    shapes = "".join(
        f'<visual><geometry><mesh filename="a.obj"{scale}/></geometry></visual>' for scale in ("", ' scale="2 2 2"')
    )
    folder = tmp_path / "project"
    folder.mkdir()
    monkeypatch.chdir(folder)
    Path("arm.urdf").write_text(f'<robot name="arm"><link name="base">{shapes}</link></robot>')
    Path("a.obj").write_bytes(OBJ.encode())
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    execute("build")
    repository = Repository(folder, monkeypatch)
    repository.commit()
    repository.git("clone", "-q", "-c", "core.autocrlf=true", ".", "../clone")
    monkeypatch.chdir("../clone")
    copy = next(Path("modelica/Arm/Resources").glob("*.obj"))
    assert [b"\r\n" in Path(path).read_bytes() for path in ("a.obj", copy)] == [True] * 2
    execute("build", "--check")
    assert "nothing changed" in execute("diff").out
    before = {path: path.read_bytes().replace(b"\r", b"") for path in Path(".urdfsync/robots").iterdir()}
    execute("build")
    assert {path: path.read_bytes().replace(b"\r", b"") for path in Path(".urdfsync/robots").iterdir()} == before
    Path("a.obj").write_bytes(OBJ.encode())  # an export with the line ends of Linux
    execute("build", "--check")
    edit("a.obj", "v 1 0 0", "v 3 0 0")
    assert "(2 parameter changes)" in execute("build").out


# --- names ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name", ["aux.urdf", "con", "nul.urdf", "a:b.urdf", "arm.urdf.", "arm.urdf ", "what?.urdf", "x|y.urdf"]
)
def test_a_name_that_windows_refuses_gets_one_line(folder: Path, execute: Execute, name: str) -> None:
    error = execute("init", name, code=2).err
    assert len(error.splitlines()) == 1
    assert "error: " in error
    assert "[internal]" not in error
    Path("urdfsync.toml").write_text(f'[robots.arm]\nsource = "{name}"\npackage = "Arm"\n')
    error = execute("build", code=2).err
    assert error.startswith("arm: 1 error, nothing was changed\n")
    assert len(error.splitlines()) == 2
    assert not Path("modelica").exists()


def test_patterns_name_sources_where_the_shell_leaves_them_to_programs(
    tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(system, "IS_WINDOWS", True)
    for name in ("arm", "leg"):
        Path("cad", name).mkdir(parents=True)
        Path("cad", name, f"{name}.urdf").write_text(robot_of("base tip 1"))
    execute("init", "cad/*/*.urdf")
    sources = [line for line in Path("urdfsync.toml").read_text().splitlines() if line.startswith("source")]
    assert sources == [f'source = "cad/{name}/{name}.urdf"' for name in ("arm", "leg")]
    assert "can't be read" in execute("add", "cad/*/*.xacro", code=2).err


@pytest.mark.windows
def test_sources_and_outputs_may_be_on_another_drive(folder: Path, execute: Execute) -> None:
    drives = [f"{letter}:\\" for letter in "CDZ" if Path(f"{letter}:\\").is_dir() and folder.drive != f"{letter}:"]
    if not drives:
        pytest.skip("there is one drive")
    with tempfile.TemporaryDirectory(dir=drives[0]) as place:
        other = Path(place)
        (other / "arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
        execute("init", other / "arm.urdf")
        assert f'source = "{(other / "arm.urdf").as_posix()}"' in Path("urdfsync.toml").read_text()
        places = f'source = "{other.as_posix()}/arm.urdf"\noutput = "{other.as_posix()}"\n'
        Path("urdfsync.toml").write_text(f'[robots.arm]\n{places}package = "Arm"\n')
        execute("build", "--trust")
        assert (other / "Arm" / "Arm.mo").is_file()
        edit(str(other / "arm.urdf"), "<link", '<link name="tool"/><joint name="j" type="fixed"><parent link="base"/>'
             '<child link="tool"/></joint><link')  # fmt: skip
        execute("build", "--check", "--trust", code=1)
        execute("build", "--trust")
        execute("build", "--check", "--trust")


# --- a command after the other, as a user runs them -----------------------------------------------------------------

STEPS: tuple[tuple[tuple[str, ...], int], ...] = (
    (("--version",), 0),
    (("--help",), 0),
    (("init", "arm.urdf"), 0),
    (("build",), 0),
    (("build", "--check"), 0),
    (("status",), 0),
    (("diff",), 0),
    (("build", "--dry-run"), 0),
    (("build", "--full"), 0),
    (("report",), 0),
    (("record", "arm.urdf", "-o", "ArmRecord.mo"), 0),
    (("schema",), 0),
    (("library",), 0),
    (("completion", "powershell"), 0),
    (("add", "second.urdf"), 0),
    (("build",), 0),
    (("resolve", "--keep"), 2),
    (("adopt", "arm"), 2),
    (("remove", "second", "--yes"), 0),
    (("hook", "check"), 2),
    (("merge-driver",), 255),
    (("fmu", "arm"), 2),
    (("identify", "arm", "--log", "missing.csv"), 2),
    (("simulate", "arm", "--method", "none"), 2),
    (("watch", "--nothing"), 2),
)


@pytest.mark.slow
def test_each_command_runs_as_a_process(folder: Path) -> None:
    """Without Python's UTF-8 mode, with the encoding that a pipe has on the system, and in a folder with an umlaut."""
    home = folder / "Häuser & Co"
    home.mkdir()
    os.chdir(home)
    for name in ("arm", "second"):
        text = '<robot name="Ö"><link name="a"/><link name="ü"/><joint name="j" type="continuous"><parent link="a"/>'
        Path(f"{name}.urdf").write_text(f'{text}<child link="ü"/></joint></robot>', encoding="utf-8")
    for words, code in STEPS:
        done = run(*words)
        told = (done.stdout + done.stderr).decode(errors="replace")
        assert done.returncode == code, (words, told)
        assert "Traceback" not in told, (words, told)
        assert "internal" not in told, (words, told)
