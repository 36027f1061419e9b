"""Joins a source with the files beside it a second time: the YAML with loops, and the rows of the catalogue.

The result has the elements of the first join, in the same lines. Only the format of the catalogue is read by the same
code.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, get_args
from xml.sax.saxutils import quoteattr

import yaml

from urdfsync.table.formats import read_sheets
from urdfsync.urdf.options import MotorNumber, Options


def join_again(parts: Sequence[bytes], options: Options) -> bytes:
    """Return the URDF, the first of `parts`, with the elements of the other parts before its last tag."""
    content, *others = parts
    for other in others:
        read = _rows(other, options) if options.motors and other is others[-1] else _loops(other)
        lines = "".join(f"\n{element}" for element in read).encode("ascii", "xmlcharrefreplace")
        end = content.rfind(b"</robot")
        content = content[:end] + lines + b"\n" + content[end:]
    return content


def _loops(content: bytes) -> Iterator[str]:
    """Yield the loops, the motors and the joints of several axes in a YAML."""
    nodes = {key.value: value for key, value in yaml.compose(content, yaml.BaseLoader).value if key.id == "scalar"}
    keys = ("closed_loop", "type", "name_mot", "joint_name", "joint_type")
    lists = {key: _plain(nodes[key]) if key in nodes and nodes[key].id == "sequence" else () for key in keys}
    for (first, second), kind in zip(lists["closed_loop"], lists["type"], strict=True):
        name, ends = quoteattr(f"{first}_{second}"), (quoteattr(first), quoteattr(second))
        kind = {"3d": "ball", "6d": "fixed"}[kind.lower()]
        yield f'<loop_joint name={name} type="{kind}"><link1 link={ends[0]}/><link2 link={ends[1]}/></loop_joint>'
    for joint in map(quoteattr, lists["name_mot"]):
        yield f"<transmission name={joint}><joint name={joint}/></transmission>"
    for joint, kind in zip(lists["joint_name"], lists["joint_type"], strict=True):
        axes = {"FIXED": "", "SPHERICAL": "xyz"}.get(kind, kind.removeprefix("UJOINT_").lower())
        yield f'<joint_axes joint={quoteattr(joint)} axes="{axes}"/>'


def _plain(node: Any) -> Any:
    return node.value if node.id == "scalar" else [_plain(each) for each in node.value]


def _rows(content: bytes, options: Options) -> Iterator[str]:
    """Yield the row of each joint that `motors` names.

    The first filled column of each number counts; of columns with the same name, the last filled one.
    """
    sheet, _ = read_sheets(content, options.catalogue)
    texts = (["" if cell is None else str(cell).strip() for cell in cells] for _, cells in sheet.rows)
    rows = {cells[0]: cells for cells in texts}
    for joint, motor in options.motors.items():
        words, filled = [f"joint={quoteattr(joint)}", f"motor={quoteattr(motor)}"], dict[str, str]()
        for title, text in zip(map(str.strip, sheet.header), rows[motor], strict=False):
            name, _, unit = title[:-1].rpartition("[") if title.endswith("]") and "[" in title else (title, "", "")
            if text:
                filled[name.strip()] = f"{text} [{unit.strip()}]"
        for number in get_args(MotorNumber):
            named = options.motor_columns.get(number, number)
            found = [filled[name] for name in ([named] if isinstance(named, str) else named) if name in filled]
            words += [f"{number}={quoteattr(text)}" for text in found[:1]]
        yield f"<catalogue_row {''.join(filter(str.isprintable, ' '.join(words)))}/>"
