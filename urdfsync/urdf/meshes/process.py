"""The process that reads meshes of strangers: what a file is made to do, it does there, within limits."""

from __future__ import annotations

import atexit
import contextlib
import os
import subprocess
import threading
from typing import IO, TypeAlias, cast

import msgspec

from urdfsync.processes import importable, python_module
from urdfsync.urdf.robot import Vector

CPU_SECONDS = 4.0
"""For one mesh, on Linux and macOS. A command with one such mesh stays below 5 s."""
MEMORY = 450_000_000
"""Bytes that the process may allocate, on Linux. Its libraries have some 50 MB besides."""
WALL_SECONDS = 60.0
"""For one mesh, everywhere. A busy machine may need so long for the CPU time."""
_LIMITS = f"reading it takes more than {CPU_SECONDS:g} s or {MEMORY // 1_000_000} MB, or ends the process that does it"
_MAX_LINE = 10_000_000
_MAX_STL = 60_000_000

Facts: TypeAlias = dict[str, list[list[float]]]
"""Of a shape, by name: see `convert`."""


class MeshError(Exception):
    """A mesh can't be used; the text is the second half of `the mesh … can't be read: it …`."""


class Request(msgspec.Struct, frozen=True):
    """A line for the process; so many bytes of a mesh follow."""

    suffix: str
    scale: Vector
    size: int
    with_hull: bool
    seconds: float
    """CPU time that reading it may take."""


class Answer(msgspec.Struct, frozen=True):
    """A line from the process; so many bytes of binary STL follow."""

    size: int = 0
    facts: Facts = {}
    problem: str = ""
    """Why the file is no mesh; empty if it is one."""
    is_last: bool = False
    """Whether the process has grown, so that the next mesh would not have all the memory that it may have."""


class MeshProcess:
    """The process, started for the first mesh and kept; after a mesh that reached a limit, the next one starts another.

    Signals are handled while it reads. It ends when this process does, however that ends, since its stdin is closed.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()  # workers of a cluster are threads

    def read(self, suffix: str, scale: Vector, content: bytes, with_hull: bool = True) -> tuple[bytes, Facts]:
        """Return a mesh as binary STL, with its facts. Raises MeshError, or OSError if no process can be started."""
        with self._lock:
            process = self._process = self._process or self._start()
            timer = threading.Timer(WALL_SECONDS, process.kill)
            timer.start()
            try:
                answer, stl = _ask(process, Request(suffix, scale, len(content), with_hull, CPU_SECONDS), content)
                if answer.is_last:
                    self.end()
            except (OSError, ValueError) as error:  # it ends, or the answer is none
                self.end()
                raise MeshError(_LIMITS) from error
            except BaseException:  # an interruption leaves the rest of an answer in the pipe
                self.end()
                raise
            finally:
                timer.cancel()
        if answer.problem:
            raise MeshError("".join(char if char.isprintable() else " " for char in answer.problem[:300]))
        return stl, answer.facts

    def end(self) -> None:
        """End the process, if there is one."""
        process, self._process = self._process, None
        if process is not None:
            atexit.unregister(self.end)
            process.kill()
            with contextlib.suppress(OSError), process:  # closes its pipes and waits; what was not written is lost
                pass

    def _start(self) -> subprocess.Popen[bytes]:
        atexit.register(self.end)
        return subprocess.Popen(  # noqa: S603 - a command of ours
            python_module("urdfsync.urdf.meshes.worker"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # each thread would have memory of its own; numpy deprecates what libraries do
            env={**os.environ, **importable(), "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore"},
            start_new_session=True,  # an interruption from the keyboard is for whoever waits, who ends the process
        )


def _ask(process: subprocess.Popen[bytes], request: Request, content: bytes) -> tuple[Answer, bytes]:
    """Have a mesh read. Raises OSError or ValueError if the process does not answer as it should."""
    stdin, stdout = cast(IO[bytes], process.stdin), cast(IO[bytes], process.stdout)
    stdin.write(msgspec.json.encode(request) + b"\n")
    stdin.write(content)
    stdin.flush()
    answer = msgspec.json.decode(stdout.readline(_MAX_LINE), type=Answer)
    stl = stdout.read(min(answer.size, _MAX_STL))
    if len(stl) != answer.size:
        raise ValueError("the answer ends early, or is too large")
    return answer, stl
