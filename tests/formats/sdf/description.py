"""Writes what sdformat's own description files list, in the form of `description.txt`.

`python tests/formats/sdf/description.py SDFORMAT/sdf > tests/formats/sdf/description.txt` renews the file. A line is
`since until path type default`, separated by tabs. `joint/axis@name` is an attribute; `link/+pose` says that a link has
the elements of `pose`, which older versions may write out.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

VERSIONS = tuple(f"1.{minor}" for minor in range(3, 13))
_ROOT = "root.sdf"


def listed(folder: Path) -> Iterator[tuple[str, str, str, str]]:
    """Yield version, path, type and default of each element and attribute."""
    for version in VERSIONS:
        waiting, known = [_ROOT], {_ROOT}
        for name in waiting:  # grows
            root = ElementTree.parse(folder / version / name).getroot()
            for path, element in _inside(root, _definition(folder, name)):
                if file := element.get("filename"):
                    yield version, f"{path}/+{_definition(folder, file)}", "", ""
                    waiting += [] if file in known else [file]
                    known.add(file)
                elif ref := element.get("ref"):
                    yield version, f"{path}/+{ref}", "", ""
                else:
                    yield version, path, element.get("type", ""), element.get("default", "")


def _definition(folder: Path, file: str) -> str:
    """Return the name of the element that a file describes in the newest version."""
    texts = (folder / version / file for version in reversed(VERSIONS))
    return ElementTree.parse(next(text for text in texts if text.exists())).getroot().get("name", "")


def _inside(element: ElementTree.Element, path: str) -> Iterator[tuple[str, ElementTree.Element]]:
    """Yield an element with all that it may have, each with its path; files that it names have that of the holder."""
    yield path, element
    for part in element:
        if part.tag == "attribute":
            yield f"{path}@{part.get('name')}", part
        elif part.tag == "include" or part.get("ref"):
            yield path, part
        elif part.tag == "element" and part.get("copy_data") != "true":
            yield from _inside(part, f"{path}/{part.get('name')}")


def united(rows: Iterator[tuple[str, str, str, str]]) -> Iterator[tuple[str, ...]]:
    """Yield each path once, with its first and last version, and its newest type and default."""
    texts = [*rows]
    named = {path for _, path, _, _ in texts}
    table = dict[str, tuple[str, ...]]()
    for version, path, kind, default in texts:
        key = _written_out(path, named)
        since = table.get(key, (version,))[0]
        table[key] = since, version, key, kind, default
    yield from (table[key] for key in sorted(table))


def _written_out(path: str, named: Mapping[str, object] | set[str]) -> str:
    """Return the path below the definition that newer versions have for a part which older ones write out."""
    words = path.replace("@", "/@").split("/")
    for number in range(1, len(words)):
        holder = "/".join(words[:number])
        if f"{holder}/+{words[number]}" in named:
            return _written_out("/".join(words[number:]).replace("/@", "@"), named)
    return path


if __name__ == "__main__":
    sys.stdout.writelines("\t".join(row) + "\n" for row in united(listed(Path(sys.argv[1]))))
