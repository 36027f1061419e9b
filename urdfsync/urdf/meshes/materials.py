"""Colours that OBJ and COLLADA files give to their shapes: of materials, and the mean ones of textures.

What is damaged or missing here has no colour, which is told, and is no fault of the shape.
"""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from lxml import etree

from urdfsync.diagnostics import cut
from urdfsync.urdf.meshes.lookup import mentioned_files, path_of_mention

Color: TypeAlias = tuple[int, int, int]
"""Red, green and blue from 0 to 255."""

_MOST_PIXELS = 5_000_000
"""Of a texture; a larger one takes more time than there is for a mesh."""
_LONGEST = 60
"""Characters of a name that are told."""
_NAMES = 3
"""So many materials without a colour are named."""
_USED_MATERIAL = re.compile(rb"^[ \t]*usemtl[ \t]([^\r\n]+)", re.MULTILINE)
_STATEMENT = re.compile(rb"^[ \t]*(newmtl|Kd|map_Kd)[ \t]([^\r\n]+)", re.MULTILINE)


def library_colors(obj: bytes, files: Mapping[str, bytes]) -> tuple[dict[bytes, Color], list[str]]:
    """Return the colours of the materials of an OBJ file by their names, and in words what is missing for others.

    `files` has its libraries and textures. A file that names no library has materials that mean nothing.
    """
    found, missing = dict[bytes, Color](), list[str]()
    for library in mentioned_files("mesh.obj", obj):
        name = b""
        if not files.get(library):
            missing.append(f"library `{cut(library, _LONGEST)}` not found")
        for statement, value in _STATEMENT.findall(files.get(library, b"")):
            if statement == b"newmtl":
                name = value.strip()
                continue
            textures = mentioned_files(library, b"map_Kd " + value) if statement == b"map_Kd" else ()
            color = _texture(textures[0], files, missing) if textures else _color(value.split())
            if color and (textures or name not in found):
                found[name] = color
    used = dict.fromkeys(name.strip() for name in _USED_MATERIAL.findall(obj)) if b"mtllib" in obj else ()
    missing += _without_color(name.decode("utf-8", "replace") for name in used if name not in found)
    return found, missing


def number_materials(obj: bytes) -> tuple[bytes, list[bytes]]:
    """Return an OBJ file whose materials are called `m0`, `m1`, …, and the names that they had."""
    used = list(dict.fromkeys(name.strip() for name in _USED_MATERIAL.findall(obj)))
    numbers = {name: b"usemtl m%d" % number for number, name in enumerate(used)}
    return _USED_MATERIAL.sub(lambda match: numbers[match[1].strip()], obj), used


def collada_colors(root: etree._Element, files: Mapping[str, bytes]) -> tuple[dict[str, Color | None], list[str]]:
    """Return the colours of the materials of a COLLADA file by their identifiers, and in words what is missing.

    `files` has its textures. A material may have no colour.
    """
    effects = {f"#{one.get('id')}": one for one in root.iterfind("{*}library_effects/{*}effect")}
    images = {one.get("id", ""): one for one in root.iterfind("{*}library_images/{*}image")}
    found, missing = dict[str, Color | None](), list[str]()
    for material in root.iterfind("{*}library_materials/{*}material"):
        instance = material.find("{*}instance_effect")
        effect = effects.get(instance.get("url", "")) if instance is not None else None
        diffuse = effect.find(".//{*}diffuse") if effect is not None else None
        texture = diffuse.find("{*}texture") if diffuse is not None else None
        if effect is not None and texture is not None:
            color = _texture(_image(texture, effect, images), files, missing)
        else:
            color = _color(_text(diffuse, "{*}color").split())
        found[material.get("id", "")] = color
    return found, missing


def unbound_materials(root: etree._Element, known: Collection[str]) -> Iterator[str]:
    """Yield in words which materials of primitives are none of those that are known, by their identifiers."""
    geometries = {f"#{one.get('id')}": one for one in root.iter("{*}geometry")}
    symbols = dict[str, None]()
    for instance in root.iter("{*}instance_geometry"):
        bound = {
            one.get("symbol", "")
            for one in instance.iter("{*}instance_material")
            if one.get("target", "").removeprefix("#") in known
        }
        geometry = geometries.get(instance.get("url", ""))
        for part in geometry.iterfind("{*}mesh/*[@material]") if geometry is not None else ():
            if (symbol := part.get("material", "")) not in bound:
                symbols[symbol] = None
    yield from _without_color(symbols)


def _without_color(names: Iterable[str]) -> Iterator[str]:
    """Yield in words that materials have no colour."""
    first, *others = [f"`{cut(name, _LONGEST)}`" for name in names] or [""]
    if first:
        shown = ", ".join([first, *others[: _NAMES - 1], *(["…"] if len(others) >= _NAMES else [])])
        yield f"no colour of material{'s' if others else ''} {shown}"


def _image(texture: etree._Element, effect: etree._Element, images: Mapping[str, etree._Element]) -> str:
    """Return the path of a texture: it names a sampler, that a surface, and that an image; or it names the image."""
    parameters = {one.get("sid", ""): one for one in effect.iter("{*}newparam")}
    name = texture.get("texture", "")
    for path in ("{*}sampler2D/{*}source", "{*}surface/{*}init_from"):
        name = _text(parameters.get(name), path) or name
    return path_of_mention(_text(images.get(name), ".//{*}init_from").encode())


def _text(element: etree._Element | None, path: str) -> str:
    found = element.find(path) if element is not None else None
    return (found.text or "").strip() if found is not None else ""


def _texture(name: str, files: Mapping[str, bytes], missing: list[str]) -> Color | None:
    """Return the mean colour of a texture; None if there is none, which is added to what is missing."""
    image = files.get(name, b"")
    color = _mean(image)
    if color is None:
        why = f"is no picture of up to {_MOST_PIXELS:,} pixels" if image else "not found"
        missing.append(f"texture `{cut(name, _LONGEST)}` {why}")
    return color


def _mean(image: bytes) -> Color | None:
    """Return the mean colour of a picture; None if it can't be read."""
    from PIL import Image  # only textures need it

    with contextlib.suppress(OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        with Image.open(io.BytesIO(image)) as picture:
            picture.draft("RGB", (64, 64))  # JPEG need not be read in full
            if picture.width * picture.height > _MOST_PIXELS:
                return None
            mean = picture.convert("RGB").resize((1, 1), Image.Resampling.BOX).tobytes()
        return mean[0], mean[1], mean[2]
    return None


def _color(numbers: Sequence[str] | Sequence[bytes]) -> Color | None:
    """Return a colour whose parts are from 0 to 1; None for what is none."""
    with contextlib.suppress(ValueError, OverflowError):
        red, green, blue = (round(255 * min(max(float(number), 0.0), 1.0)) for number in numbers[:3])
        return red, green, blue
    return None
