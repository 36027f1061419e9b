"""A process reads untrusted meshes: its limits protect against files that exploit a fault of a library."""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import subprocess
import threading
from collections.abc import Mapping, Sequence
from typing import IO, Any, TypeAlias, cast

import msgspec

from urdfsync.diagnostics import cut
from urdfsync.processes import importable, python_module
from urdfsync.urdf.robot import Vector

FOR_PICTURE = 4
"""Factor of the limits below for a picture: pictures simplify meshes of any size."""
CPU_SECONDS = 4.0
"""CPU time for one mesh, on Linux and macOS. So a command with one slow mesh stays below 5 s."""
MEMORY = 450_000_000
"""The greatest number of bytes that the process may allocate, on Linux, in addition to 50 MB for libraries."""
WALL_SECONDS = 60.0
"""Wall time for one mesh, on all systems: a busy machine may need so long for this CPU time."""
COARSER = "export the mesh with fewer triangles"
"""The hint for a mesh beyond a limit."""
_LONGEST = 300
"""The greatest number of characters of an error message from a library."""
_MAX_LINE = 10_000_000
_MAX_FILE = 100_000_000

MeshFacts: TypeAlias = dict[str, Any]
"""Facts of a shape by name: see `convert`."""


STL_COUNT = slice(80, 84)
_STL_FACET = 50


class MeshError(Exception):
    """An unusable mesh; the text completes the message `the mesh … can't be read: …`."""

    def __init__(self, message: str, hint: str = "export the mesh again, best as STL or OBJ") -> None:
        super().__init__(message)
        self.hint = hint


class MeshRequest(msgspec.Struct, frozen=True):
    """A line to the process; the bytes of a mesh and of other files follow."""

    suffix: str
    scale: Vector = (1.0, 1.0, 1.0)
    with_hull: bool = True
    colors: str = ""
    """Name of the fact with the colours, see `lookup.PARTS`; empty without colours."""
    as_obj: bool = False
    """Whether the parts of a mesh are written as OBJ instead of STL."""
    most: int = 0
    """For a picture: the most triangles of the simplified mesh. Zero stands for a file of the package."""
    size: int = 0
    """Size of the mesh in bytes; `MeshProcess` fills in this field and the fields below."""
    others: Mapping[str, int] = {}
    """Size in bytes of each material library and texture of the mesh, by path."""
    seconds: float = 0.0
    """Limit of the CPU time, in s."""


class MeshAnswer(msgspec.Struct, frozen=True):
    """A line from the process; the bytes of each file follow."""

    sizes: tuple[int, ...] = ()
    facts: tuple[MeshFacts, ...] = ()
    problem: str = ""
    """The reason why the file can't be used; empty for a usable file."""
    hint: str = ""
    is_last: bool = False
    """Whether the process is too large to give the next mesh its full memory."""


def is_binary_stl(content: bytes) -> bool:
    """Return whether an STL file is binary. Some binary files begin with `solid`, as texts do."""
    return len(content) == STL_COUNT.stop + _STL_FACET * int.from_bytes(content[STL_COUNT], "little")


class MeshProcess:
    """The process, which starts for the first mesh.

    After a mesh that reached a limit, the next mesh starts a new process. This program handles signals while the
    process reads. When this program ends, the end of stdin ends the process.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()  # a script may build in several threads

    def read(
        self, request: MeshRequest, content: bytes, others: Mapping[str, bytes] | None = None
    ) -> list[tuple[bytes, MeshFacts]]:
        """Return the imported files of a mesh, with their facts.

        Raises MeshError, or OSError if the process can't start.
        """
        others = others or {}
        sizes = {name: len(other) for name, other in others.items()}
        request = msgspec.structs.replace(
            request, size=len(content), others=sizes, seconds=CPU_SECONDS * (FOR_PICTURE if request.most else 1)
        )
        with self._lock:
            process = self._process = self._process or self._start()
            timer = threading.Timer(WALL_SECONDS, process.kill)
            timer.start()
            try:
                answer, files = _ask(process, request, (content, *others.values()))
                if answer.is_last:
                    self.end()
            except (OSError, ValueError) as error:  # the process has ended, or the answer is invalid
                raise self._failure(process, request) from error
            except BaseException:  # after an interruption, the pipe may hold half an answer
                self.end()
                raise
            finally:
                timer.cancel()
        if answer.problem:
            text = "".join(char if char.isprintable() else " " for char in cut(answer.problem, _LONGEST))
            raise MeshError(text, answer.hint)
        return list(zip(files, answer.facts, strict=True))

    def _failure(self, process: subprocess.Popen[bytes], request: MeshRequest) -> MeshError:
        """End the process; return the limit that it passed."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(1)  # it may end a moment after its pipes
        code = -(process.returncode or 0)
        self.end()
        limit = {signal.SIGKILL: WALL_SECONDS, getattr(signal, "SIGPROF", None): request.seconds}.get(code)
        if limit is None:
            return MeshError("the process that reads the file fails")
        return MeshError(f"reading the file takes more than {limit:g} s", COARSER)

    def end(self) -> None:
        """End the process, if it runs."""
        process, self._process = self._process, None
        if process is not None:
            atexit.unregister(self.end)
            process.kill()
            with contextlib.suppress(OSError), process:  # closes the pipes and waits
                pass

    def _start(self) -> subprocess.Popen[bytes]:
        atexit.register(self.end)
        return subprocess.Popen(  # noqa: S603 - a command of ours
            python_module("urdfsync.urdf.meshes.worker"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # threads need memory; libraries use deprecated parts of numpy
            env={**os.environ, **importable(), "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore"},
            process_group=0,  # Ctrl-C reaches only the waiting program, which ends the process
        )


def _ask(
    process: subprocess.Popen[bytes], request: MeshRequest, contents: Sequence[bytes]
) -> tuple[MeshAnswer, list[bytes]]:
    """Send a mesh to the process, and return its answer. Raises OSError or ValueError for a missing or wrong answer."""
    stdin, stdout = cast(IO[bytes], process.stdin), cast(IO[bytes], process.stdout)
    stdin.write(msgspec.json.encode(request) + b"\n")
    for content in contents:
        stdin.write(content)
    stdin.flush()
    answer = msgspec.json.decode(stdout.readline(_MAX_LINE), type=MeshAnswer)
    files = [stdout.read(min(size, _MAX_FILE)) for size in answer.sizes]
    if tuple(map(len, files)) != answer.sizes:
        raise ValueError("the answer ends early, or is too large")
    return answer, files
