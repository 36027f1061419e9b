"""Lists a robot's mesh files, their possible places, and their names in the package, without reading files.

The URI as written and the scale identify a mesh, since the imported file has the scale applied. URIs are resolved as in
ROS, and in further ways that real URDF files need: `package://` and `model://` with search paths, unexpanded `$(find
…)`, `modelica://`, `file:` in all its spellings, relative paths, backslashes and percent-encoding. Other schemes have
no place: a build doesn't use the network.
"""

from __future__ import annotations

import hashlib
import itertools
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath, PureWindowsPath
from urllib.parse import unquote

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import Dependency, Import, Lookup
from urdfsync.formats.urdf.robot import Collision, Geometry, Link, Mesh, Robot, Vector, Visual

UNIT_SCALE: Vector = (1.0, 1.0, 1.0)
BOUNDS, HULL, VOLUME = "bounds", "hull", "volume"
"""Names of facts: all models need `bounds`, contacts with the ground also need `hull`; `volume` shows densities."""
PARTS, COLORS, TEXTURED, COLORLESS = "parts", "colors", "textured", "colorless"
"""Names of facts of meshes with their own colours.

`parts` lists the colours of a mesh that becomes one file per colour. If another shape needs the whole mesh, `colors`
lists them instead: then the files per colour stand beside the whole mesh. `textured` tells whether textures were found.
`colorless` names the missing colours.
"""
COLORED = (".dae", ".obj")
"""Formats with colours."""
GLTF = ".gltf"
AS_IS = (".stl", ".obj")
"""Formats that Modelica tools can draw: such files without a scale are imported unchanged."""

_SCHEME = r"([A-Za-z][A-Za-z0-9+.-]+):(?://)?(.*)"  # at least two letters: `C:` is a drive
_FOUND = r"(?:file:(?://)?)?\$\((?:find|find-pkg-share)\s++([^)]++)\)/*(.*)"
_DRIVE = r"/*([A-Za-z]:/.*)"
_MENTIONS = {
    ".obj": re.compile(rb"^[ \t]*mtllib[ \t]([^\r\n]+)", re.MULTILINE),
    ".mtl": re.compile(rb"^[ \t]*map_Kd[ \t]([^\r\n]+)", re.MULTILINE),
    # the <init_from> of a surface names an image in this file, not another file
    ".dae": re.compile(rb"<surface\b[^<>]*>\s*<init_from>[^<>]+</init_from>|<init_from>([^<>]+)</init_from>"),
    GLTF: re.compile(rb'"uri"\s*:\s*"([^":]+\.bin)"'),
}
"""Patterns for names of other files, by the suffix of the file: libraries of materials, textures and buffers."""
_LIBRARY = re.compile(rb"(?i)\S.*?\.mtl(?=\s|$)|\S.*")
"""One of the libraries that a line names. Names may contain blanks."""
_TEXTURE_OPTION = re.compile(r"-[a-zA-Z]+|[-+.\deE]+|on|off")
"""An option, or its value, before the name of a texture in a library of materials."""
_UNFIT = "[\x00-\x1f\x7f\ud800-\udfff]"
_NAME_BYTES = 255
_PATH_BYTES = 4095
_STEM_LENGTH = 40


def key(mesh: Mesh) -> str:
    """Return the key of a mesh among the imports: URI and scale, such as `package://arm/a.dae scale 1.0 1.0 1.0`."""
    return f"{mesh.filename} scale {' '.join(repr(float(number)) for number in mesh.scale)}"


def mesh(key: str) -> Mesh:
    """Return the mesh with this key, or the mesh of a further file with this key."""
    filename, _, numbers = key.rpartition(" scale ")
    x, y, z = map(float, numbers.split(" ")[:3])
    return Mesh(filename, (x, y, z))


def suffix(uri: str) -> str:
    """Return the suffix of a mesh file in lower case, with the dot, or an empty text."""
    return PurePosixPath(_file_name(uri)).suffix.lower()


def as_is(mesh: Mesh) -> bool:
    """Return whether the file is imported byte for byte."""
    return suffix(mesh.filename) in AS_IS and mesh.scale == UNIT_SCALE


def _has_colors(mesh: Mesh, visual: Visual) -> bool:
    """Return whether a visual has the colours of its mesh, since the URDF gives no colour."""
    return suffix(mesh.filename) in COLORED and (visual.material is None or visual.material.rgba is None)


def mentioned(dependency: Dependency, file: str, content: bytes) -> Sequence[str]:
    """Return the other files that a mesh needs: buffers of glTF, or materials and textures for its colours."""
    is_needed = TEXTURED in dependency.facts or suffix(dependency.uri) == GLTF
    return mentioned_files(file, content) if is_needed else ()


def findings(imports: Mapping[str, Import], robot: Robot) -> Iterator[tuple[str, Diagnostic]]:  # noqa: ARG001 - see `Mentions`
    """Yield a warning for each mesh with missing colours, and a note if meshes have textures."""
    for key, file in imports.items():
        if missing := file.facts.get(COLORLESS):
            message = f"mesh `{mesh(key).filename}` lacks colours: "
            hint = "put the missing files beside the mesh, or give the visual a <material>"
            yield key, Diagnostic(Severity.WARNING, "mesh-colors", message + "; ".join(missing), hint=hint)
    count = sum(bool(file.facts.get(TEXTURED)) for file in imports.values())
    if count:
        message = f"{count} {'mesh has' if count == 1 else 'meshes have'} textures, which become their mean colours"
        yield "", Diagnostic(Severity.NOTE, "texture", message)


def mentioned_files(file: str, content: bytes) -> list[str]:
    """Return the paths of a mesh's buffers, and of files with its colours, relative to the folder of the mesh.

    `file` is the path of the mesh or of its library of materials. Names in `file` count from the folder of `file`.
    """
    path = PurePosixPath(file)
    suffix = path.suffix.lower()
    mentions = _MENTIONS[suffix].findall(content) if suffix in _MENTIONS else ()
    if suffix == ".obj":
        mentions = [library for line in mentions for library in _LIBRARY.findall(line)]
    names = dict.fromkeys(map(path_of_mention, mentions))
    # buffers of glTF have to be in the folder of the mesh or below
    return [str(path.parent / name) for name in names if name and not (suffix == GLTF and ".." in name.split("/"))]


def path_of_mention(mention: bytes) -> str:
    """Return the relative path of a file that another file names; empty for an absolute path or a URI."""
    words = unquote(mention.decode("utf-8", "replace")).strip()
    if words.startswith("-"):
        words = " ".join(itertools.dropwhile(_TEXTURE_OPTION.fullmatch, words.split()))
    text = words.replace("\\", "/").removeprefix("./")
    return "" if text.startswith("/") or ":" in text or re.search(_UNFIT, text) else text


def target(mesh: Mesh) -> str:
    """Return the path of the imported file in the package folder.

    Its digits are a hash of URI and scale: meshes with one file name have different paths, even ignoring case.
    """
    stem = re.sub("[^A-Za-z0-9_-]+", "_", PurePosixPath(_file_name(mesh.filename)).stem)
    stem = stem[:_STEM_LENGTH].strip("_-") or "mesh"
    digits = hashlib.sha256(key(mesh).encode("utf-8", "surrogatepass")).hexdigest()[:8]
    return f"Resources/{stem}_{digits}{suffix(mesh.filename) if as_is(mesh) else '.stl'}"


def dependencies(
    links: Sequence[Link], kinds: Sequence[str], lookup: Lookup, lines: Mapping[str, int], *, touches: bool
) -> tuple[Dependency, ...]:
    """Return the mesh files of links in the order of keys.

    Each pair of URI and scale comes once. `kinds` are the shapes that count: `visual`, `collision`. If the robot
    `touches` the ground, its standing height needs the outermost points of collisions, whatever `kinds` says. `lines`
    has the source's line of each element by path. A dependency has the line of a shape, such as `link wheel / visual 2
    / geometry`, else of its link.
    """
    shapes_of = defaultdict[Mesh, list[tuple[int, bool]]](list)
    touching = {collision.geometry for link in links for collision in link.collisions} if touches else set[Geometry]()
    for link in links:
        for kind in kinds:
            shapes: Sequence[Visual | Collision] = link.visuals if kind == "visual" else link.collisions
            for number, shape in enumerate(shapes, start=1):
                if isinstance(mesh := shape.geometry, Mesh):
                    place = f"link {link.name} / {kind} {number} / geometry"
                    line = lines.get(place, lines.get(f"link {link.name}", 0))
                    shapes_of[mesh].append((line, isinstance(shape, Visual) and _has_colors(mesh, shape)))
    return tuple(
        Dependency(
            key(mesh),
            mesh.filename,
            candidates(mesh.filename, lookup),
            target(mesh),
            "mesh",
            min((line for line, _ in shapes if line), default=0),
            facts=_facts([is_colored for _, is_colored in shapes], mesh in touching),
        )
        for mesh, shapes in sorted(shapes_of.items(), key=lambda item: key(item[0]))
    )


def _facts(colored: Sequence[bool], touches: bool) -> tuple[str, ...]:
    """Return the names of the facts of a mesh; for each shape, `colored` says whether it shows the mesh's colours."""
    hull = (HULL,) if touches else ()
    colors = (PARTS if all(colored) else COLORS, TEXTURED, COLORLESS) if any(colored) else ()
    return (BOUNDS, VOLUME, *hull, *colors)


def candidates(uri: str, lookup: Lookup) -> tuple[Path, ...]:
    """Return possible absolute paths of the file, best first; none for the URI of another machine.

    The URI is taken literally first, then without percent-encoding.
    """
    texts = (uri.strip(), unquote(uri.strip()))
    paths = (path for text in texts if not re.search(_UNFIT, text) for path in _places(text.replace("\\", "/"), lookup))
    absolute_paths: dict[Path, None] = {}
    for path in paths:
        sizes = [len(part.encode("utf-8", "surrogatepass")) for part in path.parts]
        # no file system allows longer names: a search for one raises OSError
        if path.is_absolute() and max(sizes) <= _NAME_BYTES and sum(sizes) + len(sizes) <= _PATH_BYTES:
            absolute_paths[path] = None
    return tuple(absolute_paths)


def _places(text: str, lookup: Lookup) -> Iterator[Path]:
    if match := re.fullmatch(_FOUND, text):
        yield from _in_package(match[1].strip(), match[2], lookup)
    elif not (match := re.fullmatch(_SCHEME, text)):
        yield from _at_path(text, lookup)
    elif match[1].lower() == "file":
        path = re.sub("^localhost/", "/", match[2])
        yield from _at_path(path, lookup)
        yield from _on_share(f"//{path}", lookup)  # `file://server/share/a.stl`
    elif match[1].lower() in ("package", "model"):
        package, _, rest = match[2].partition("/")
        yield from _in_package(package, rest, lookup)
    elif match[1].lower() == "modelica":
        class_name, _, rest = match[2].lstrip("/").partition("/")
        yield from _in_library(class_name, rest, lookup)


def _at_path(text: str, lookup: Lookup) -> Iterator[Path]:
    """Yield the places of a path without a scheme: absolute, or below the source's parents and search paths."""
    if drive := re.fullmatch(_DRIVE, text):
        yield Path(drive[1])
    elif text.startswith("/"):
        yield from _on_share(text, lookup)
        yield Path("/" + text.lstrip("/"))
    elif text:
        yield from (folder / text for folder in (*lookup.source.parents, *lookup.package_paths))


def _on_share(text: str, lookup: Lookup) -> Iterator[Path]:
    """Yield the path `//server/share/a.stl` on Windows, if the source or a search path is on this share.

    Windows signs in to each server that is looked at, and another one may be a stranger's.
    """
    share = PureWindowsPath(text).drive.lower()
    if share and share in {folder.drive.lower() for folder in (lookup.source, *lookup.package_paths)}:
        yield Path(text)


def _in_package(package: str, text: str, lookup: Lookup) -> Iterator[Path]:
    """Yield the places in a package.

    The package is a search path, a folder above the source, or a child of either. Exporters may leave out the package's
    name (`package:///a.stl`), name a folder beside the source, or write a slash too many. A copy of a package may have
    another name.
    """
    path = text.lstrip("/")
    named = bool(package)
    if not named:
        yield from _at_path(path, lookup)
        package, _, path = path.partition("/")
    if path:
        for folder in (*lookup.package_paths, *lookup.source.parents):
            yield folder / package / path
            if folder.name == package:
                yield folder / path
        if package in lookup.packages:
            yield lookup.packages[package] / path
        elif named and lookup.guess:
            yield from (folder / path for folder in lookup.source.parents)


def _in_library(class_name: str, text: str, lookup: Lookup) -> Iterator[Path]:
    """Yield the places in a Modelica library: on MODELICAPATH, then in folders of its name above the source.

    `modelica://Plant.Arms/a.stl` is in the folder of the class `Plant.Arms`, or in the folder with its file. A path out
    of the library has no place.
    """
    name, *inner = class_name.split(".")
    path = text.lstrip("/")
    if not path or ".." in path.split("/") or re.match(_DRIVE, path) or not all(map(str.isidentifier, (name, *inner))):
        return
    roots = [lookup.libraries[name]] if name in lookup.libraries else []
    for folder in lookup.source.parents:
        roots.append(folder / name)
        if folder.name.partition(" ")[0] == name:
            roots.append(folder)
    for root in roots:
        for depth in range(len(inner), -1, -1):
            yield root.joinpath(*inner[:depth], path)


def _file_name(uri: str) -> str:
    return unquote(uri.strip().replace("\\", "/")).rpartition("/")[2]
