"""Loads three.js from trimesh, whose viewer contains three.js.

This repository contains no third-party JavaScript. The page gets three.js from the installed trimesh, which reads
meshes anyway: r140, 0.7 MB, under the MIT licence. meshcat and viser have three.js in one file with their own programs
(0.9 and 0.8 MB), and would be further dependencies.
"""

from __future__ import annotations

import importlib.util
import re
import zipfile
from pathlib import Path
from typing import NamedTuple

from urdfsync.common.diagnostics import UrdfsyncError

_ARCHIVE, _MEMBER = "resources/templates/viewer.zip", "viewer.html.template"
_SCRIPT = "<script>"
_END = "THREE.GLTFLoader=GLTFLoader;})();"
"""The end of the loader; the viewer's own code follows."""
_FORBIDDEN = ("</script", "<!--")
"""Texts that would end the script's element, or change its meaning."""


class Library(NamedTuple):
    """A third-party script."""

    text: str
    title: str
    """Name and version."""
    licence: str


def load() -> Library:
    """Return three.js. Raises UrdfsyncError if the installed trimesh lacks three.js."""
    spec = importlib.util.find_spec("trimesh")  # an import of trimesh would take half a second
    for folder in (spec.submodule_search_locations or ()) if spec else ():
        try:
            with zipfile.ZipFile(Path(folder, _ARCHIVE)) as archive:
                page = archive.read(_MEMBER).decode()
        except (OSError, KeyError, zipfile.BadZipFile, UnicodeDecodeError):
            break
        text = page.partition(_SCRIPT)[2].partition(_END)[0] + _END
        release = re.search(r'"use strict";const \w+="(\d+)"', text[:2000])
        if release and "@license" in text[:200] and _END in page and not any(part in text for part in _FORBIDDEN):
            comment = (line.strip(" *") for line in text.partition("*/")[0].splitlines())
            licence = [line for line in comment if line.startswith(("Copyright", "SPDX-License-Identifier"))]
            return Library(text.replace("\r", ""), f"three.js r{release[1]}", "; ".join(licence))
        break
    message, hint = "the installed trimesh has no three.js for the page", "install trimesh again, version 5"
    raise UrdfsyncError.of("no-threejs", message, hint=hint)
