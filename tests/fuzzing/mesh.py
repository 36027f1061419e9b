"""Mutated meshes of every format, read as a build reads them.

Limits of time and memory that hold are no fault. An exception other than the finding, a file that appears, more memory
than the limits allow, or a result that is no sound STL file with bounded facts, is one.
"""

from __future__ import annotations

import contextlib
import functools
import math
import resource
import struct
import tempfile
import warnings
from pathlib import Path
from random import Random

from support.meshes import VERTICES, dae, gltf, ply, tenfold
from support.workplace import Fault

from fuzzing.cases import run_cases
from urdfsync.diagnostics import SourceError
from urdfsync.domain import Conversion, Dependency
from urdfsync.urdf.meshes import process
from urdfsync.urdf.meshes.convert import convert
from urdfsync.urdf.meshes.lookup import BOUNDS, HULL, key, target
from urdfsync.urdf.robot import Mesh

SECONDS = 0.5
"""CPU time that one mesh may take here; each that takes longer costs a process, too."""
MEMORY = 500_000
"""Kilobytes of this process."""

_FACETS = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
_GLTF = gltf([{"mesh": 0, "translation": [1, 2, 3]}, {"children": [0]}], [1])


def _glb() -> bytes:
    text = _GLTF.encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


SEEDS: tuple[tuple[str, bytes], ...] = (
    (".stl", bytes(80) + struct.pack("<I", 2) + struct.pack("<12fH", *range(12), 0) * 2),
    (".stl", f"solid box\n{_FACETS * 2}endsolid box\n".encode()),
    (".obj", VERTICES + b"v 0 0 1\nvn 0 0 1\nf 1 2 3 4\nf 1//1 -2//1 -1//1\n"),
    (".off", b"OFF\n# four\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
    (".ply", ply(3, 1, rest=struct.pack("<Biii", 3, 0, 1, 2))),
    (".ply", ply(0, 0).partition(b"end_header")[0].replace(b"binary_little_endian", b"ascii").replace(b" 0\n", b" 3\n")
     + b"end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n3 2 1 0\n"),
    (".dae", dae().encode()),
    (".dae", tenfold(2, '<matrix>1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1</matrix><instance_geometry url="#g"/>').encode()),
    (".gltf", _GLTF.encode()),
    (".glb", _glb()),
)  # fmt: skip
"""A sound file of each format."""

_WORDS = (
    *(b"0", b"-1", b"3", b"255", b"1e308", b"-1e999", b"nan", b"4294967295", b"99999999999999999999", b"1_0", b"0x1"),
    *(b"#", b"\\\n", b"\r", b"\0", b"\xff\xfe", b"/", b"<", b">", b'"', b"{", b"[", b"]}", b",", b"&lt;", b"\x1b[2J"),
    *(b"solid", b"vertex", b"endfacet", b"f ", b"v ", b"OFF", b"element face 9\n", b"list uint int", b"end_header\n"),
    *(b"<node>", b"</node>", b"<polylist>", b'url="#n2"', b'"children":[0]', b'"uri":"/etc/passwd"', b"#g", b"null"),
)


def mutate(random: Random, content: bytes) -> bytes:
    """Change a file in one to six places."""
    data = bytearray(content)
    for _ in range(random.randint(1, 6)):
        begin = random.randrange(len(data) + 1)
        end = min(len(data), begin + int(random.expovariate(0.1)))
        kind = random.randrange(7)
        if kind == 0:
            data[begin:end] = random.randbytes(end - begin)
        elif kind == 1:
            data[begin:begin] = random.choice(_WORDS)
        elif kind == 2:
            data[begin:end] = random.choice(_WORDS)
        elif kind == 3:
            del data[begin:end]
        elif kind == 4:
            data[begin:begin] = data[begin:end] * random.choice((1, 2, 10, 1000))
        elif kind == 5 and begin + 4 <= len(data):
            data[begin : begin + 4] = struct.pack("<I", random.choice((0, 1, 0xFFFF, 0x7FFFFFFF, 0xFFFFFFFF)))
        else:
            del data[begin + random.randrange(100) :]
    return bytes(data)


def _case(folder: Path, random: Random) -> str:
    suffix, content = random.choice(SEEDS)
    if random.random() < 0.02:  # what one format is made of, under the name of another
        suffix, _ = random.choice(SEEDS)
    mesh = Mesh(f"mesh{suffix}", random.choice(((1.0, 1.0, 1.0), (0.001, 0.001, 0.001), (-1.0, 2.0, 1e30))))
    facts = random.choice(((BOUNDS,), (BOUNDS, HULL)))
    dependency = Dependency(key(mesh), mesh.filename, (), target(mesh), "mesh", facts=facts)
    outcome = "read"
    with contextlib.chdir(folder):
        try:
            _check(mesh, convert(dependency, folder / mesh.filename, mutate(random, content)))
        except SourceError as error:
            (finding,) = error.diagnostics
            outcome, message = "refused", finding.message
            if not message.isprintable() or len(message) >= 500 or "ended the process" in message:
                raise Fault(repr(message)) from None
    files = sorted(path.name for path in folder.iterdir())
    for name in files:
        (folder / name).unlink()
    if files:
        raise Fault(f"files appeared: {files}")
    return outcome


def _check(mesh: Mesh, found: Conversion) -> None:
    """A result is a whole STL file with bounded facts."""
    content = found.content
    is_stl = target(mesh).endswith(".stl") and not mesh.filename.endswith(".stl")
    if is_stl and len(content) != 84 + 50 * int.from_bytes(content[80:84], "little"):
        raise Fault("it is no binary STL file")
    least, greatest = found.facts["bounds"]
    numbers = [*least, *greatest, *(number for point in found.facts.get(HULL, ()) for number in point)]
    if not all(map(math.isfinite, numbers)) or any(a > b for a, b in zip(least, greatest, strict=True)):
        raise Fault(f"its facts are {found.facts}")


def run(count: int, seed: int) -> int:
    """Run cases; returns the number of faults."""
    process.CPU_SECONDS = SECONDS
    with tempfile.TemporaryDirectory() as name, warnings.catch_warnings():
        warnings.simplefilter("error")  # they would be printed
        faults = run_cases("mesh", functools.partial(_case, Path(name)), count, seed)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    if peak > MEMORY:
        print(f"mesh: the memory grew to {peak:,} kB")  # noqa: T201
    return faults + (peak > MEMORY)
