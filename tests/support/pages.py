"""Pages for tests: words, tags, scripts, and the numbers that the scripts get."""

from __future__ import annotations

import json
from collections.abc import Mapping
from html.parser import HTMLParser
from pathlib import Path
from typing import cast


class Elements(HTMLParser):
    """The start tags of a page, and the texts of its scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.raw: list[tuple[str, dict[str, str | None], str]] = []
        self.words = ""
        self._open: tuple[str, dict[str, str | None]] | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        self._open = (tag, dict(attrs)) if tag in ("script", "style") else None

    def handle_data(self, data: str) -> None:
        if self._open:
            self.raw.append((*self._open, data))
        else:
            self.words += data

    def handle_endtag(self, tag: str) -> None:
        self._open = None


def read(file: Path) -> Elements:
    return Elements(file.read_text("utf-8"))


def data_of(page: Elements) -> dict[str, object]:
    (text,) = (text for _, attributes, text in page.raw if attributes.get("id") == "data")
    values: dict[str, object] = json.loads(text)
    return values


def faces_of(file: Path) -> dict[str, int]:
    """Return the number of triangles of each mesh."""
    meshes = cast(Mapping[str, list[int]], data_of(read(file))["meshes"])
    return {name: faces for name, (_, faces, *_) in meshes.items()}
