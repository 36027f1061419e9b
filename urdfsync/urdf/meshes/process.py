"""The process that reads untrusted meshes: its limits contain a file that exploits a fault of a library."""

from __future__ import annotations

import atexit
import contextlib
import os
import subprocess
import threading
from collections.abc import Mapping, Sequence
from typing import IO, Any, TypeAlias, cast

import msgspec

from urdfsync.diagnostics import cut
from urdfsync.processes import importable, python_module
from urdfsync.urdf.robot import Vector

FOR_PICTURE = 4
"""Factor of the limits below for a picture, which simplifies meshes of any size."""
CPU_SECONDS = 4.0
"""CPU time for one mesh, on Linux and macOS. A command with one such mesh stays below 5 s."""
MEMORY = 450_000_000
"""The most bytes that the process allocates, on Linux, besides 50 MB for its libraries."""
WALL_SECONDS = 60.0
"""Wall time for one mesh, on all systems. A busy machine may need so long for the CPU time above."""
_LIMITS = f"reading it takes more than {CPU_SECONDS:g} s or {MEMORY // 1_000_000} MB, or ends the process that does it"
_LONGEST = 300
"""The most characters of a library's error."""
_MAX_LINE = 10_000_000
_MAX_FILE = 100_000_000

Facts: TypeAlias = dict[str, Any]
"""Facts of a shape by their names: see `convert`."""


_STL_COUNT = slice(80, 84)
_STL_FACET = 50


class MeshError(Exception):
    """An unusable mesh; its text completes the message `the mesh … can't be read: it …`."""


class Request(msgspec.Struct, frozen=True):
    """A line for the process; the bytes of a mesh and of other files follow."""

    suffix: str
    scale: Vector = (1.0, 1.0, 1.0)
    with_hull: bool = True
    colors: str = ""
    """Name of the fact with the colours, see `lookup.PARTS`; empty for none."""
    as_obj: bool = False
    """Whether the parts of a mesh are OBJ, and not STL."""
    most: int = 0
    """The most triangles of a picture, to which a larger mesh is simplified; 0 for a file of the package."""
    size: int = 0
    """Size of the mesh in bytes; `MeshProcess` fills in this field and those below."""
    others: Mapping[str, int] = {}
    """Sizes of the other files by their paths."""
    seconds: float = 0.0
    """CPU time that reading it may take."""


class Answer(msgspec.Struct, frozen=True):
    """A line from the process; the bytes of each file follow."""

    sizes: tuple[int, ...] = ()
    facts: tuple[Facts, ...] = ()
    problem: str = ""
    """Why the file can't be used; empty if it can."""
    is_last: bool = False
    """Whether the process has grown so much that the next mesh would not have its full memory."""


def is_binary_stl(content: bytes) -> bool:
    """Return whether an STL file is binary; some binary ones begin with `solid`, as texts do."""
    return len(content) == _STL_COUNT.stop + _STL_FACET * int.from_bytes(content[_STL_COUNT], "little")


class MeshProcess:
    """The process, which starts for the first mesh. After a mesh that reached a limit, the next mesh starts a new one.

    Signals are handled while it reads. It always ends with this process, which closes its stdin by ending.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()  # the workers of a Dask cluster are threads

    def read(
        self, request: Request, content: bytes, others: Mapping[str, bytes] | None = None
    ) -> list[tuple[bytes, Facts]]:
        """Return the imported files of a mesh, with their facts.

        Raises MeshError, or OSError if no process can be started.
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
            except (OSError, ValueError) as error:  # the process ended, or the answer is invalid
                self.end()
                raise MeshError(_LIMITS) from error
            except BaseException:  # after an interruption, the pipe still has half an answer
                self.end()
                raise
            finally:
                timer.cancel()
        if answer.problem:
            raise MeshError("".join(char if char.isprintable() else " " for char in cut(answer.problem, _LONGEST)))
        return list(zip(files, answer.facts, strict=True))

    def end(self) -> None:
        """End the process, if there is one."""
        process, self._process = self._process, None
        if process is not None:
            atexit.unregister(self.end)
            process.kill()
            with contextlib.suppress(OSError), process:  # closes the pipes and waits; unwritten data are lost
                pass

    def _start(self) -> subprocess.Popen[bytes]:
        atexit.register(self.end)
        return subprocess.Popen(  # noqa: S603 - a command of ours
            python_module("urdfsync.urdf.meshes.worker"),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # each thread needs its own memory; libraries use deprecated parts of numpy
            env={**os.environ, **importable(), "OPENBLAS_NUM_THREADS": "1", "PYTHONWARNINGS": "ignore"},
            process_group=0,  # Ctrl-C reaches only the process that waits, which then ends this one
        )


def _ask(process: subprocess.Popen[bytes], request: Request, contents: Sequence[bytes]) -> tuple[Answer, list[bytes]]:
    """Send a mesh to the process, and return its answer. Raises OSError or ValueError for a missing or wrong one."""
    stdin, stdout = cast(IO[bytes], process.stdin), cast(IO[bytes], process.stdout)
    stdin.write(msgspec.json.encode(request) + b"\n")
    for content in contents:
        stdin.write(content)
    stdin.flush()
    answer = msgspec.json.decode(stdout.readline(_MAX_LINE), type=Answer)
    files = [stdout.read(min(size, _MAX_FILE)) for size in answer.sizes]
    if tuple(map(len, files)) != answer.sizes:
        raise ValueError("the answer ends early, or is too large")
    return answer, files
