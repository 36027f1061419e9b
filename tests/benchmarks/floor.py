"""What no first build can do without, and nothing else: `python floor.py PART TASK`.

The task is a JSON file. Its part `modules` loads all modules that a build loads, and that is all. `files` renders
beside that as many texts from a `template` of one expression, of as many characters (`sizes`, by the paths in
`folder`), and writes them as files. `package` loads no more than it needs, reads the `source`, renders the very texts
of its package and writes these: it takes no configuration, decides on nothing, records nothing.

Files are written under another name, and get their own when all are on the disk.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
from collections.abc import Mapping
from typing import Any


def main(part: str, file: str) -> None:
    """Carry out a part of a task."""
    with open(file, encoding="utf-8") as opened:  # noqa: PTH123 - here and below: what is not needed is not loaded
        task = json.load(opened)
    if part == "package":
        _write(task["folder"], _package(task["source"]))
        return
    for module in task["modules"]:
        importlib.import_module(module)
    if part == "files":
        _write(task["folder"], _texts(task["template"], task["sizes"]))


def _texts(template: str, sizes: Mapping[str, int]) -> dict[str, bytes]:
    from pathlib import Path

    from urdfsync.render import Renderer

    renderer, name = Renderer([Path(template).parent]), Path(template).name
    return {path: renderer.render(name, {"text": "x" * size}).encode() for path, size in sizes.items()}


def _package(source: str) -> dict[str, bytes]:
    """The files of the package of `<name>.urdf`, by their paths; without cross-check."""
    from pathlib import Path

    from urdfsync.config import templates_folder
    from urdfsync.domain import Target, Templates
    from urdfsync.engine.generate import generate
    from urdfsync.urdf.domain import DOMAIN
    from urdfsync.urdf.options import Options

    domain: Any = DOMAIN
    name = Path(source).stem.capitalize()
    with open(source, "rb") as opened:  # noqa: PTH123
        content = opened.read()
    options = Options(cross_check=False)
    snapshot = domain.read(content, source, options).snapshot
    templates = Templates((templates_folder(domain),), "")
    found = generate(domain, snapshot, {}, Target(name, name), options, templates)
    texts = {path: found.content(path) for path in found.artifacts}
    texts |= {path: "".join(f"{each}\n" for each in names).encode() for path, names in found.orders.items()}
    return {f"{name}/{path}": text for path, text in texts.items()}


def _write(folder: str, texts: Mapping[str, bytes]) -> None:
    for place in {path.rpartition("/")[0] for path in texts}:
        os.makedirs(f"{folder}/{place}", exist_ok=True)  # noqa: PTH103
    for path, text in texts.items():
        descriptor = os.open(f"{folder}/{path}.new", os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        os.write(descriptor, text)
        os.close(descriptor)
    os.sync()
    for path in texts:
        os.rename(f"{folder}/{path}.new", f"{folder}/{path}")  # noqa: PTH104


if __name__ == "__main__":
    main(*sys.argv[1:])
