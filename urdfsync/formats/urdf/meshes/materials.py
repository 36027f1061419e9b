"""Reads the colours of materials in OBJ and COLLADA files, and the mean colours of textures.

A shape with a damaged or missing material has no colour.
"""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from lxml import etree

from urdfsync.formats.urdf.meshes.lookup import mentioned_files, path_of_mention

Color: TypeAlias = tuple[int, int, int]
"""Red, green and blue from 0 to 255."""

_MOST_PIXELS = 5_000_000
"""The greatest number of pixels of a texture: a larger texture exceeds the time limit of a mesh."""
_USED_MATERIAL = re.compile(rb"^[ \t]*usemtl[ \t]([^\r\n]+)", re.MULTILINE)
_STATEMENT = re.compile(rb"^[ \t]*(newmtl|Kd|map_Kd)[ \t]([^\r\n]+)", re.MULTILINE)


def library_colors(obj: bytes, files: Mapping[str, bytes]) -> dict[bytes, Color]:
    """Return the colours of an OBJ file's materials by name; `files` has the libraries and textures."""
    colors = dict[bytes, Color]()
    for library in mentioned_files("mesh.obj", obj):
        name = b""
        for statement, value in _STATEMENT.findall(files.get(library, b"")):
            if statement == b"newmtl":
                name = value.strip()
                continue
            textures = mentioned_files(library, b"map_Kd " + value) if statement == b"map_Kd" else ()
            color = _mean(files.get(textures[0], b"")) if textures else _color(value.split())
            if color and (textures or name not in colors):
                colors[name] = color
    return colors


def number_materials(obj: bytes) -> tuple[bytes, list[bytes]]:
    """Rename the materials of an OBJ file to `m0`, `m1`, …; return the file and the former names."""
    used = list(dict.fromkeys(name.strip() for name in _USED_MATERIAL.findall(obj)))
    numbers = {name: b"usemtl m%d" % number for number, name in enumerate(used)}
    return _USED_MATERIAL.sub(lambda match: numbers[match[1].strip()], obj), used


def effect_color(
    effect: etree._Element, images: Mapping[str, etree._Element], files: Mapping[str, bytes]
) -> Color | None:
    """Return the diffuse colour of a COLLADA effect, or the mean colour of its texture; None without both."""
    texture = effect.find(".//{*}diffuse/{*}texture")
    if texture is None:
        return _color(_text(effect, ".//{*}diffuse/{*}color").split())
    return _mean(files.get(_image(texture, effect, images), b""))


def _image(texture: etree._Element, effect: etree._Element, images: Mapping[str, etree._Element]) -> str:
    """Return the path of a texture, which names an image directly or through a sampler and a surface."""
    parameters = {part.get("sid", ""): part for part in effect.iter("{*}newparam")}
    name = texture.get("texture", "")
    for path in ("{*}sampler2D/{*}source", "{*}surface/{*}init_from"):
        name = _text(parameters.get(name), path) or name
    return path_of_mention(_text(images.get(name), ".//{*}init_from").encode())


def _text(element: etree._Element | None, path: str) -> str:
    return element.findtext(path, "").strip() if element is not None else ""


def _mean(image: bytes) -> Color | None:
    """Return the mean colour of a picture; None if the picture can't be read."""
    from PIL import Image  # only textures need PIL

    with contextlib.suppress(OSError, ValueError, SyntaxError, Image.DecompressionBombError):
        with Image.open(io.BytesIO(image)) as picture:
            picture.draft("RGB", (64, 64))  # a JPEG is read at a low resolution
            if picture.width * picture.height > _MOST_PIXELS:
                return None
            mean = picture.convert("RGB").resize((1, 1), Image.Resampling.BOX).tobytes()
        return mean[0], mean[1], mean[2]
    return None


def _color(numbers: Sequence[str] | Sequence[bytes]) -> Color | None:
    """Return the colour of three numbers from 0 to 1; None for other words."""
    with contextlib.suppress(ValueError, OverflowError):
        red, green, blue = (round(255 * min(max(float(number), 0.0), 1.0)) for number in numbers[:3])
        return red, green, blue
    return None
