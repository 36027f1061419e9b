"""Runs tests with a Windows Python under Wine: `python -m tests --windows FOLDER`; FOLDER/python starts this Python.

Its packages are those of `pip install --target FOLDER/site` for Windows. There is no git for Windows: `git.exe` asks
this process to run the system's git.
"""

from __future__ import annotations

import os
import re
import shutil
import socket
import struct
import subprocess
import tempfile
import threading
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
QUICK = (
    *("test_scenarios", "common", "commands", "merge", "project", "formats/urdf/parse", "formats/urdf/meshes"),
    *("engine/test_saved_in_between", "watch/test_robot"),
)
"""Tests of which those marked slow are left out."""
ALONE = ("analysis/checks/test_process",)
"""Likewise, but in a run of their own: beside many others, Wine counts the time of other processes as theirs."""
SLOW = ("common/test_system", "test_state_machine")
"""Tests of which those marked slow run."""
_COMPILER = "x86_64-w64-mingw32-gcc"
_AS_WINDOWS_10 = """
import ctypes, winreg
if hasattr(ctypes.windll.ntdll, "wine_get_version"):
    key = winreg.CreateKey(winreg.HKEY_CURRENT_USER, "Software\\\\Wine")
    winreg.SetValueEx(key, "Version", 0, winreg.REG_SZ, "win10")
"""
"""Wine says that it is Windows 7, for which Python takes empty messages of pipes otherwise: its pools of processes
wait for ever."""


def run(folder: Path, arguments: Sequence[str] = ()) -> int:
    """Run the tests, or those that arguments of pytest name; return the exit code."""
    if not (folder / "python").is_file():
        print(f"skipped: {folder} has no Windows Python")  # noqa: T201
        return 0
    (folder / "cpython/lib/site-packages/wheels.pth").write_text(windows_path(folder / "site"))
    environment = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
    # the bytecode of the same Python on this system names other files
    environment["PYTHONPYCACHEPREFIX"] = windows_path(folder / "bytecode")
    subprocess.run([folder / "python", "-c", _AS_WINDOWS_10], stdin=subprocess.DEVNULL, check=True)
    with socket.create_server(("127.0.0.1", 0)) as server, tempfile.TemporaryDirectory(dir=_fast_folder()) as temporary:
        if shutil.which(_COMPILER) and shutil.which("git"):
            program = folder / "git" / "git.exe"
            program.parent.mkdir(exist_ok=True)
            source = Path(__file__).with_name("git_for_windows.c")
            subprocess.run([_COMPILER, "-municode", "-o", program, source, "-lws2_32"], check=True)
            environment |= {"WINEPATH": windows_path(program.parent), "URDFSYNC_GIT_PORT": str(server.getsockname()[1])}
            threading.Thread(target=_serve, args=(server, folder), daemon=True).start()
        quick, alone, slow = (
            [f"tests/{name}" if (ROOT / "tests" / name).is_dir() else f"tests/{name}.py" for name in names]
            for names in (QUICK, ALONE, SLOW)
        )
        without_slow = "-m", "not slow and not large"
        runs = [[*quick, *without_slow], [*alone, *without_slow], [*slow, "-m", "slow"]]
        runs = [list(arguments)] if arguments else runs
        common = ["-m", "pytest", "-q", "-n", str(os.cpu_count() or 1), "--dist", "worksteal", "-p", "no:cacheprovider"]
        codes = [
            subprocess.run(
                [str(folder / "python"), *common, f"--basetemp={windows_path(Path(temporary, str(number)))}", *words],
                cwd=ROOT,
                env=environment,
                stdin=subprocess.DEVNULL,
                check=False,
            ).returncode
            for number, words in enumerate(runs)
        ]
    return max(codes)


def windows_path(path: Path) -> str:
    """The path of a file as programs under Wine see it."""
    return "Z:" + str(path.resolve()).replace("/", "\\")


def _fast_folder() -> str | None:
    return "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


def _serve(server: socket.socket, folder: Path) -> None:
    while True:
        try:
            connection, _ = server.accept()
        except OSError:  # the tests are over
            return
        threading.Thread(target=_run_git, args=(connection, folder), daemon=True).start()


def _run_git(connection: socket.socket, windows: Path) -> None:
    """Run git for one `git.exe`, with paths of this system; a merge driver runs the Windows Python."""
    with connection, connection.makefile("rwb") as stream:

        def take() -> bytes:
            (size,) = struct.unpack("<I", stream.read(4))
            return stream.read(size)

        folder, arguments, variables, content = (
            _local(take()),
            list(iter(take, b"")),
            list(iter(take, b"")),
            iter(take, b""),
        )
        names = dict(variable.decode().split("=", 1) for variable in variables)
        environment = {name: text for name, text in os.environ.items() if not name.startswith("GIT_")}
        environment |= {name: _local(text.encode()) for name, text in names.items()}
        environment["PYTHONPATH"] = windows_path(ROOT)
        program = f"{windows}/cpython/python.exe"
        command = ["git", *(_local(each).replace(program, f"{windows}/python") for each in arguments)]
        done = subprocess.run(
            command, cwd=folder, env=environment, input=b"".join(content), capture_output=True, check=False
        )
        out = re.sub(rb"(?m)^/", b"Z:/", done.stdout) if b"rev-parse" in arguments else done.stdout
        for part in (str(done.returncode).encode() + b"\0", out, done.stderr):
            stream.write(struct.pack("<I", len(part)) + part)


def _local(text: bytes) -> str:
    """An argument with the paths of this system."""
    words = text.decode()
    if words == "nul":
        return os.devnull
    return re.sub(r"(?i)z:(?=[\\/])", "", words).replace("\\", "/") if re.search(r"(?i)z:[\\/]", words) else words
