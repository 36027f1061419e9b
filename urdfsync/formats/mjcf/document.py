"""Makes one text of an MJCF and the files that it includes, for MuJoCo to read from memory.

Each element has a line of its own, and each line a place in a file: so MuJoCo's messages can name the user's lines.
The text of an attached model begins below all earlier lines, so that no two texts share a line number. MuJoCo gets the
bytes of each mesh under a name of ours, and opens no file itself. Textures and skins only draw, and height fields are
terrain: they are left out, and so is their reading; a geom of a height field becomes a plane.

As in MuJoCo, the name of an included file counts from the folder of the source, then from that of the including file.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import PurePosixPath
from typing import NamedTuple
from xml.etree.ElementTree import Element

from urdfsync.formats.translation.files import Files, SourcePlace, TranslationError
from urdfsync.formats.translation.writer import in_xml

_LEFT_OUT = ("texture", "hfield", "skin")
"""Elements that only draw, or are terrain."""
FLEXIBLE = ("flex", "flexcomp")
"""Elements of flexible bodies."""
_NOTED = frozenset({*_LEFT_OUT, *FLEXIBLE, "light", "camera", "exclude", "numeric", "text", "tuple"})
"""Elements that no model has."""
_OF_TEXTURES = ("texture", "texrepeat", "texuniform")
"""Attributes of materials and lights that refer to textures."""
_FOLDERS = ("meshdir", "texturedir", "assetdir", "strippath")
_MOST_ELEMENTS = 20_000
"""The most elements of a model with its copies. The largest robots have 3,000; for 30,000 copies MuJoCo takes 20 s."""


class MjcfDocument(NamedTuple):
    """The text of an MJCF, and what MuJoCo needs to read it."""

    source: str
    """Path of the source."""
    text: str
    places: list[SourcePlace]
    """Place of each line of the text and of the `models`."""
    meshes: dict[str, str]
    """Paths of the files of meshes, by their names in the text."""
    contents: dict[str, bytes]
    """Contents of these files by the same names."""
    models: dict[str, str]
    """Texts of the models that the text attaches, by their names in it."""
    noted: list[tuple[str, str, SourcePlace]]
    """Tag, name and place of each element that no model has."""

    def place(self, line: int) -> SourcePlace:
        """Return the place of a line; the first place for an unknown line."""
        return self.places[line - 1 if 0 < line <= len(self.places) else 0]


def read_document(
    source: str,
    files: Files,
    main: MjcfDocument | None = None,
    place: SourcePlace = ("", 0),
    around: tuple[str, ...] = (),
) -> MjcfDocument:
    """Read an MJCF with all files that it names, or a model that `main` attaches at a place. Raises TranslationError.

    Meshes and models of an attached model are added to those of `main`.
    """
    shared = main or MjcfDocument(source, "", [], {}, {}, {}, [])
    if source in around:
        raise TranslationError("the model attaches itself", place)
    root = files.parse(source, place)
    if root.tag != "mujoco":
        message = f"the root element is <{root.tag}> and not <mujoco>"
        raise files.fault(root, message, "name the file that includes this one")
    _include(root, source, os.path.dirname(source), files, (source,))  # noqa: PTH120
    _name_files(root, source, files, shared, (*around, source))
    if (count := _count(root)) > _MOST_ELEMENTS:
        message = f"the model has {count:,} elements, and urdfsync reads up to {_MOST_ELEMENTS:,}"
        raise files.fault(root, message, "take copies out of <replicate>")
    lines = list(_lines(root, files.places))
    text = "\n" * len(shared.places) + "\n".join(line for line, _ in lines)
    shared.places.extend(place for _, place in lines)
    return shared._replace(text=text)


def _include(element: Element, file: str, main: str, files: Files, around: tuple[str, ...]) -> None:
    """Replace each `<include>` below an element by the elements of its file; `main` is the folder of the source."""
    children = list[Element]()
    for child in element:
        if child.tag != "include":
            _include(child, file, main, files, around)
            children.append(child)
            continue
        name = child.get("file", "").replace("\\", "/")
        if not name:
            raise files.fault(child, "<include> names no file", 'write file="…"')
        if len(child):
            raise files.fault(child, "<include> has elements of its own", "take them out")
        folders = (main, os.path.dirname(file))  # noqa: PTH120
        paths = [os.path.normpath(os.path.join(folder, name)) for folder in folders]  # noqa: PTH118
        path = next(filter(files.is_there, paths), paths[0])
        files.check_inside(path, files.places[child])
        if path in around:
            raise files.fault(child, f"{path} includes itself", "take one <include> out")
        root = files.parse(path, files.places[child])
        _include(root, path, main, files, (*around, path))
        children += root
    element[:] = children


def _name_files(root: Element, source: str, files: Files, shared: MjcfDocument, around: tuple[str, ...]) -> None:
    """Give each file of a mesh or of an attached model a name of ours; leave out what only draws."""
    folder, settings = os.path.dirname(source), dict[str, str]()  # noqa: PTH120
    for compiler in root.iter("compiler"):
        settings |= {key: compiler.attrib.pop(key) for key in _FOLDERS if key in compiler.attrib}
    meshes = settings.get("meshdir", settings.get("assetdir", "")).replace("\\", "/")
    for holder in [*root.iter()]:
        for element in [child for child in holder if child.tag in _NOTED and holder.tag != "default"]:
            shared.noted.append((element.tag, element.get("name", ""), files.places[element]))
            if element.tag in _LEFT_OUT:
                holder.remove(element)
        for size in holder.findall("size"):  # it may ask for gigabytes, for contacts that no translation computes
            holder.remove(size)
        if "hfield" in holder.attrib:  # other elements may name the geom
            del holder.attrib["hfield"]
            holder.attrib |= {"type": "plane", "size": "1 1 1"}
        if holder.tag in ("material", "light"):
            for name in _OF_TEXTURES:
                holder.attrib.pop(name, None)
            holder[:] = []
            if holder.get("type") == "image":
                del holder.attrib["type"]
    for element in root.iter():
        if "file" not in element.attrib:
            continue
        place, name = files.places[element], element.get("file", "").replace("\\", "/")
        if element.tag == "mesh":
            name = PurePosixPath(name).name if settings.get("strippath") == "true" else os.path.join(meshes, name)  # noqa: PTH118
            path = os.path.normpath(os.path.join(folder, name))  # noqa: PTH118
            element.attrib.setdefault("name", PurePosixPath(name).stem)  # MuJoCo's own rule
            own = f"{len(shared.meshes)}{PurePosixPath(name).suffix}"
            shared.meshes[own], shared.contents[own] = path, files.read(path, place)
            element.set("file", own)
        elif element.tag == "model" and root.find("asset") is not None:
            path = os.path.normpath(os.path.join(folder, name))  # noqa: PTH118
            files.check_inside(path, place)
            inner = read_document(path, files, shared, place, around)
            element.attrib.setdefault("name", PurePosixPath(name).stem)
            own = f"{len(shared.models)}.xml"
            shared.models[own] = inner.text
            element.set("file", own)
        else:
            message = f"<{element.tag}> reads a file, which urdfsync does not support"
            raise files.fault(element, message, "take the element out")


def _count(element: Element) -> int:
    """Return the count of elements in an element, with the copies of each `<replicate>`."""
    text = element.get("count", "").strip() if element.tag == "replicate" else ""
    return 1 + sum(map(_count, element)) * (int(text) if text.isdecimal() and len(text) < 10 else 1)


def _lines(element: Element, places: Mapping[Element, SourcePlace]) -> Iterator[tuple[str, SourcePlace]]:
    """Yield the lines of an element, each with its place."""
    place = places[element]
    yield f"<{element.tag}{in_xml(element.attrib)}{'' if len(element) else '/'}>", place
    for child in element:
        yield from _lines(child, places)
    if len(element):
        yield f"</{element.tag}>", place
