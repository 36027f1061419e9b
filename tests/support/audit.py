"""What a process and its children write, run and connect to, as Python's audit events tell.

`install` writes a `sitecustomize` module, which every Python process loads that has its folder in PYTHONPATH.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

MODULE = '''\
"""Writes down each audit event that changes a file, starts a program, opens a connection or runs code."""

import json
import os
import sys

LOG = os.open({log!r}, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)
CHANGES = {{
    "os.remove": 1, "os.rename": 2, "os.mkdir": 1, "os.rmdir": 1, "os.link": 2, "os.symlink": 2, "os.truncate": 1,
    "os.chmod": 1, "os.chown": 1, "os.utime": 1, "shutil.rmtree": 1, "os.setxattr": 1,
}}
RUNS = ("subprocess.Popen", "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.startfile", "pty.spawn")
CONNECTS = ("socket.connect", "socket.bind", "socket.getaddrinfo", "urllib.Request", "ftplib.connect")


def note(kind, *values):
    os.write(LOG, (json.dumps([kind, *map(str, values)]) + "\\n").encode())


def absolute(path):
    if isinstance(path, int):
        return f"handle {{path}}"
    return os.path.abspath(os.fsdecode(path))


def audit(event, arguments):
    if event == "open":
        path, mode, flags = arguments
        if flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC) and not isinstance(path, int):
            note("write", absolute(path))
    elif event in CHANGES:
        for path in arguments[: CHANGES[event]]:
            note("write", absolute(path))
    elif event == "exec":
        name = getattr(arguments[0], "co_filename", "")
        if name and not name.startswith("<"):
            note("code", absolute(name))
    elif event in RUNS:
        command = arguments[1] if event == "subprocess.Popen" else arguments[0]
        note("run", *(command if isinstance(command, (list, tuple)) else [command]))
    elif event in CONNECTS:
        note("connect", event, *arguments[1:2])


sys.addaudithook(audit)
'''


def install(folder: Path, log: Path) -> None:
    """Make a folder for PYTHONPATH whose processes write their events to a log."""
    folder.mkdir()
    (folder / "sitecustomize.py").write_text(MODULE.format(log=str(log)))


def events(log: Path) -> list[Sequence[str]]:
    """The events so far: a kind (`write`, `run`, `connect`, `code`), then paths or words. Each is there once."""
    if not log.exists():
        return []
    found = dict.fromkeys(log.read_text().splitlines())
    return [json.loads(line) for line in found]
