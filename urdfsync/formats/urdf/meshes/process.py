"""Reads untrusted meshes in a process with limits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import msgspec

from urdfsync.common.diagnostics import cut
from urdfsync.common.processes import python_module
from urdfsync.common.processes.limited import LimitedProcess
from urdfsync.formats.urdf.robot import Vector

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


def is_binary_stl(content: bytes) -> bool:
    """Return whether an STL file is binary. Some binary files begin with `solid`, as texts do."""
    return len(content) == STL_COUNT.stop + _STL_FACET * int.from_bytes(content[STL_COUNT], "little")


class MeshProcess(LimitedProcess):
    """The process, which reads one mesh after the other."""

    def command(self) -> tuple[list[str], dict[str, str]]:
        """Return the command that starts the process."""
        return python_module("urdfsync.formats.urdf.meshes.worker"), {}

    def read(
        self, request: MeshRequest, content: bytes, others: Mapping[str, bytes] | None = None
    ) -> list[tuple[bytes, MeshFacts]]:
        """Return the imported files of a mesh, with their facts.

        Raises MeshError, or OSError if the process can't start.
        """
        others, seconds = others or {}, CPU_SECONDS * (FOR_PICTURE if request.most else 1)
        sizes = {name: len(other) for name, other in others.items()}
        request = msgspec.structs.replace(request, size=len(content), others=sizes, seconds=seconds)
        try:
            answer, files = self.ask(request, (content, *others.values()), seconds, WALL_SECONDS)
        except TimeoutError as error:
            raise MeshError(str(error), COARSER) from error
        except ValueError as error:
            raise MeshError(str(error)) from error
        if answer.problem:
            text = "".join(char if char.isprintable() else " " for char in cut(answer.problem, _LONGEST))
            raise MeshError(text, answer.hint)
        return list(zip(files, answer.facts, strict=True))
