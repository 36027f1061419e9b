"""What no build can do without, and nothing else: `python floor.py TASK`.

The task is a JSON file: the `modules` to load, and the `sizes` (characters) of files by their paths in `folder`. Each
text is rendered from a `template` of one expression, is written under another name, and gets its own name when all are
on the disk. Without `sizes`, loading is all.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import sys


def main(file: str) -> None:
    """Carry out a task."""
    gc.set_threshold(100_000)  # as `urdfsync` does
    with open(file, encoding="utf-8") as opened:  # noqa: PTH123 - here and below: what is not needed is not loaded
        task = json.load(opened)
    for module in task["modules"]:
        importlib.import_module(module)
    if task["sizes"]:
        _write(task["folder"], _rendered(task["template"], task["sizes"]))
    gc.freeze()


def _rendered(template: str, sizes: dict[str, int]) -> dict[str, bytes]:
    from pathlib import Path

    from urdfsync.render import Renderer

    renderer, name = Renderer([Path(template).parent]), Path(template).name
    return {path: renderer.render(name, {"text": "x" * size}).encode() for path, size in sizes.items()}


def _write(folder: str, texts: dict[str, bytes]) -> None:
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
