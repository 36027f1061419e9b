"""The program that reads meshes one after the other, each within limits of time and memory; `process` starts it."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import IO

import msgspec

from urdfsync.common.processes import limits
from urdfsync.common.processes.limited import LimitedAnswer, answer_requests
from urdfsync.formats.urdf.meshes.lookup import COLORLESS, COLORS, TEXTURED
from urdfsync.formats.urdf.meshes.process import COARSER, FOR_PICTURE, MEMORY, MeshError, MeshRequest, is_binary_stl

if sys.platform != "win32":
    import resource

_UNUSED = ("PIL", "httpx", "networkx", "rtree", "scipy", "shapely")
"""Optional imports of trimesh that no mesh needs: they would take half a second and 60 MB."""
_GROWN = 200_000_000
"""A process with more allocated bytes reads no further mesh; its libraries take 70 MB."""


def main() -> None:
    """Answer requests until stdin is closed."""
    sys.modules.update(dict.fromkeys(_UNUSED))  # type: ignore[arg-type] # None lets an import fail
    answer_requests(_answer)


def _answer(line: bytes, contents: IO[bytes]) -> tuple[LimitedAnswer, list[bytes]]:
    request = msgspec.json.decode(line, type=MeshRequest)
    content = contents.read(request.size)
    others = {name: contents.read(size) for name, size in request.others.items()}
    # these imports come after `main` has blocked unused packages, and before limits are set
    from urdfsync.formats.urdf.meshes import geometry, simplify

    is_plain = bool(request.most) and request.suffix == ".stl" and is_binary_stl(content)
    if not is_plain:  # plain meshes need no trimesh, which takes half a second
        from urdfsync.formats.urdf.meshes.reading import read_mesh, read_parts

        sys.modules.pop("PIL", None)  # textures need PIL, trimesh does not
    try:
        with limits(request.seconds, MEMORY * (FOR_PICTURE if request.most else 1)):
            if request.most:
                read = (
                    geometry.stl_triangles(content)
                    if is_plain
                    else read_mesh(request.suffix, content, others, math.inf)
                )
                packed, facts = simplify.packed(geometry.scaled(read, request.scale), request.most)
                files, all_facts = [packed], [facts]
            elif not request.colors:
                read = read_mesh(request.suffix, content, others)
                mesh, facts = geometry.import_form(read, request.scale, request.with_hull)
                files, all_facts = [geometry.binary_stl(mesh)], [facts]
            else:
                parts, missing = read_parts(request.suffix, content, others)
                meshes = [*parts.values()]
                if len(parts) == 1 or request.colors == COLORS:
                    meshes = [geometry.joined(meshes), *(meshes if len(parts) > 1 else ())]
                forms = [geometry.import_form(mesh, request.scale, request.with_hull) for mesh in meshes]
                write = geometry.obj if request.as_obj else geometry.binary_stl
                files, all_facts = [write(mesh) for mesh, _ in forms], [facts for _, facts in forms]
                is_textured = any(other and not name.lower().endswith(".mtl") for name, other in others.items())
                all_facts[0] |= {request.colors: [*parts], TEXTURED: is_textured, COLORLESS: missing}
    except MeshError as error:
        return LimitedAnswer(problem=str(error), hint=error.hint), []
    except MemoryError:
        size = MEMORY * (FOR_PICTURE if request.most else 1) // 1_000_000
        problem = f"reading the file takes more than {size} MB of memory"
        return LimitedAnswer(problem=problem, hint=COARSER, is_last=True), []
    return LimitedAnswer(facts=tuple(all_facts), is_last=_allocated() > _GROWN), files


def _allocated() -> int:
    """Return the bytes that count against the memory limit, freed bytes included; 0 without a limit."""
    if sys.platform == "linux":
        return int(Path("/proc/self/statm").read_text().split()[5]) * resource.getpagesize()
    return 0


if __name__ == "__main__":
    main()
