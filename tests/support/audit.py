"""Python's audit events of a process: changed files, started programs, connections, and code that runs."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterator
from typing import Any

CHANGES = {
    **dict.fromkeys(("os.remove", "os.mkdir", "os.rmdir", "os.chmod", "os.chown", "os.utime"), (slice(1), 1)),
    "os.rename": (slice(2), 2),
    "os.link": (slice(1, 2), 2),
    "os.symlink": (slice(1, 2), 1),
    "os.truncate": (slice(1), 0),
    "os.setxattr": (slice(1), 0),
    "shutil.rmtree": (slice(1), 1),
}
"""By event: the arguments that are changed paths, and the number of last arguments that are folders of these paths."""
STARTS = {"os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.startfile", "pty.spawn", "subprocess.Popen"}
CONNECTIONS = {"socket.connect", "socket.bind", "socket.getaddrinfo", "urllib.Request", "ftplib.connect"}

Listener = Callable[[str, str], None]
"""Takes a kind (`write`, `start`, `connect`, `code`), and a path or a program."""
listeners: list[Listener] = []


def _meanings(event: str, arguments: tuple[Any, ...]) -> Iterator[tuple[str, object]]:
    if event == "open":
        path, mode, flags = arguments[:3]
        writes = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC
        if any(letter in mode for letter in "wax+") if isinstance(mode, str) else flags & writes:
            yield "write", path
    elif event in CHANGES:
        changed, folders = CHANGES[event]
        if not any(isinstance(folder, int) and folder >= 0 for folder in arguments[len(arguments) - folders :]):
            yield from (("write", path) for path in arguments[changed])  # not from an open folder
    elif event == "exec":
        yield "code", getattr(arguments[0], "co_filename", "<")
    elif event in STARTS:
        command = arguments[1] if event == "subprocess.Popen" else arguments[0]
        yield "start", command[0] if isinstance(command, list | tuple) else command
    elif event in CONNECTIONS:
        yield "connect", event


def _audit(event: str, arguments: tuple[Any, ...]) -> None:
    if not listeners:
        return
    for kind, what in _meanings(event, arguments):
        if isinstance(what, str | bytes | os.PathLike):
            name = os.fsdecode(what)
            if kind in ("write", "code") and not name.startswith("<"):
                name = os.path.abspath(name)  # noqa: PTH100 - no file system access: this is an audit hook
            for listener in listeners:
                listener(kind, name)


sys.addaudithook(_audit)


def log_to(file: str) -> None:
    """Append the events of this process to a file, a line of JSON each."""
    log = os.open(file, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)

    def note(kind: str, what: str) -> None:
        os.write(log, (json.dumps([kind, what]) + "\n").encode())

    listeners.append(note)
