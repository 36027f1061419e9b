"""Steps of two branches that change the network of the fixture `project`, as calls and as words."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from support.networks import LADDER, edit

_NOTES = "note", "edit"
"""Verbs of steps that edit built files."""


def export(change: Callable[[list[dict[str, Any]]], object]) -> None:
    """Change the elements of the source, which has a blank line between two of them, so that git merges it."""
    network = json.loads(Path("ladder.json").read_text())
    change(network["elements"])
    lines = ",\n\n".join(json.dumps(element) for element in network["elements"])
    head = json.dumps({**network, "elements": []}).removesuffix("]}")
    Path("ladder.json").write_text(f"{head}\n\n{lines}\n\n]}}\n")


def set_value(name: str, value: float) -> None:
    def change(found: list[dict[str, Any]]) -> None:
        (element,) = (one for one in found if one["name"] == name)
        element["ohm" if "ohm" in element else "farad"] = value

    export(change)


def drop(name: str) -> None:
    export(lambda found: found.remove(next(one for one in found if one["name"] == name)))


def add(name: str) -> None:
    export(lambda found: found.append({"name": name, "between": ["in", "ground"], "ohm": 5}))


def rename(old: str, new: str) -> None:
    export(lambda found: next(one for one in found if one["name"] == old).update(name=new))


def note(path: str, text: str) -> None:
    """Add a line before the end of a class."""
    found = Path(path).read_text()
    Path(path).write_text(re.sub(r"\nend (\w+);\n$", rf"\n  // {text}\nend \1;\n", found))


def perform(steps: str, build: Callable[[], object] = lambda: None) -> None:
    """Do the steps of a text, one per line: change the source, build, then edit files of the package.

    `set NAME VALUE`, `add NAME`, `drop NAME`, `rename OLD NEW`; `note FILE TEXT`, `edit FILE OLD => NEW`.
    """
    lines = [line.split(" ", 2) for line in steps.splitlines()]
    for verb, *words in lines:
        if verb == "set":
            set_value(words[0], float(words[1]))
        elif verb == "rename":
            rename(*words)
        elif verb not in _NOTES:
            {"add": add, "drop": drop}[verb](*words)
    build()
    for verb, *words in lines:
        if verb in _NOTES:
            path = f"{LADDER}/{words[0]}"
            note(path, words[1]) if verb == "note" else edit(path, *words[1].split(" => "))
