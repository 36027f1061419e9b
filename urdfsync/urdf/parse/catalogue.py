"""Reads a catalogue: a table whose rows have numbers of drives, such as rotors, gears and limits.

The rows that the option `motors` names go to the end of the URDF, as they are written. So all readers of the URDF have
them, with their lines, and each converts the units itself:

    <catalogue_header effort="stall torque [N.cm]" rotor_inertia="rotor [g.cm2]"/>
    <catalogue_row joint="elbow" motor="MX-64" effort="600" rotor_inertia="12.5"/>
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.spelling import nearest
from urdfsync.urdf.options import MotorNumber, Options
from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Motor, Transmission

_PLACES: Mapping[MotorNumber, tuple[str, str, str]] = {
    "effort": ("limit", "N.m", "N"),
    "velocity": ("limit", "rad/s", "m/s"),
    "damping": ("dynamics", "N.m.s/rad", "N.s/m"),
    "friction": ("dynamics", "N.m", "N"),
    "armature": ("dynamics", "kg.m2", "kg"),
    "reduction": ("transmission", "1", "rad/m"),
    "rotor_inertia": ("transmission", "kg.m2", "kg.m2"),
}
"""Numbers of a row: the field of `Joint` that has each, and its unit for a turning and for a sliding joint."""
NUMBERS: Mapping[tuple[str | int, ...], str] = {(field, number): number for number, (field, _, _) in _PLACES.items()}
"""Numbers of a row by their paths in a joint."""


class Row(NamedTuple):
    """A row of the catalogue for one joint; numbers that are not of its gear stand in the joint's elements by now."""

    motor: Motor
    gear: Mapping[str, float]
    line: int


def file(options: Options) -> str:
    """Return the path of the catalogue from the configuration's folder; empty if no joint needs it."""
    return options.catalogue if options.motors else ""


def join(content: bytes, other: bytes, file: str, options: Options) -> tuple[bytes, Sequence[tuple[int, int]]]:
    """Return the URDF with the rows before its last tag, and the line of each in both files; see `Catalogue`.

    The check of options reports missing rows. Raises SourceError for any other fault of the table.
    """
    if (end := content.rfind(b"</robot")) < 0:
        return content, ()
    elements, first = list(_elements(other, file, options)), content.count(b"\n", 0, end) + 2
    lines = "".join(f"\n{element}" for element, _ in elements).encode("ascii", "xmlcharrefreplace")
    places = [(number, line) for number, (_, line) in enumerate(elements, first)]
    return content[:end] + lines + b"\n" + content[end:], places


def _elements(content: bytes, file: str, options: Options) -> Iterator[tuple[str, int]]:
    """Yield each element, and its line in the catalogue."""
    from xml.sax.saxutils import quoteattr  # 9 ms, and few robots need it

    from urdfsync.table.formats import read_sheets  # likewise
    from urdfsync.table.reading import name_and_unit

    def write(tag: str, **attributes: object) -> str:
        texts = {name: "".join(c if c.isprintable() else " " for c in str(text)) for name, text in attributes.items()}
        return f"<{tag} {' '.join(f'{name}={quoteattr(text)}' for name, text in texts.items())}/>"

    sheet, _ = read_sheets(content, file)
    names = [name_and_unit(cell)[0] for cell in sheet.header]
    wanted = {number: options.motor_columns.get(number, number) for number in _PLACES}
    columns = {number: names.index(column) for number, column in wanted.items() if column in names}
    named = options.motor_columns if columns else wanted
    if missing := [column for column in named.values() if column not in names]:
        near = nearest(missing[0], names)
        hint = f"did you mean `{near}`?" if near else "name its columns in `motor_columns`"
        raise SourceError.of("no-column", f"there is no column `{missing[0]}`", file, 1, hint=hint)
    yield write("catalogue_header", **{number: sheet.header[column] for number, column in columns.items()}), 1
    rows = dict[str, tuple[int, Sequence[object]]]()
    for line, cells in sheet.rows:
        name = str(cells[0]).strip()
        if name in rows and name in options.motors.values():
            message = f"the row `{name}` stands in line {rows[name][0]}, too"
            raise SourceError.of("duplicate-key", message, file, line, hint="rename one")
        rows[name] = line, cells
    for joint, name in options.motors.items():
        line, cells = rows.get(name, (0, names))
        if len(cells) != len(names):
            message = f"the row `{name}` has {len(cells)} cells, and the header {len(names)}"
            raise SourceError.of("ragged-row", message, file, line, hint="fill each cell, or quote its text")
        if name in rows:
            filled = {number: cells[column] for number, column in columns.items() if cells[column] is not None}
            yield write("catalogue_row", joint=joint, motor=name, **filled), line


def read_rows(reader: Reader, root: Element) -> Mapping[str, Row]:
    """Put the numbers of the catalogue's rows into the elements of their joints; return the rows by joint.

    The elements of the catalogue leave the document. Rows of joints without an axis are left out: the check of options
    reports them.
    """
    header, rows = root.find("catalogue_header"), root.findall("catalogue_row")
    for element in (*root.findall("catalogue_header"), *rows):
        root.remove(element)
    if header is None or not rows:
        return {}
    from urdfsync.table.model import Options as TableOptions  # 15 ms, and few robots need it
    from urdfsync.table.model import Sheet
    from urdfsync.table.reading import SheetReader

    numbers = [number for number in _PLACES if number in header.attrib]
    by_line = {reader.element_lines[row]: row for row in rows}
    cells = [(line, [row.get(number) for number in numbers]) for line, row in by_line.items()]
    table, sheet = SheetReader("", TableOptions()), Sheet([header.get(number, "") for number in numbers], cells)
    columns = dict(zip(numbers, table.columns(sheet, set()), strict=True))
    found, read = dict[str, Row](), list(table.values(sheet, [*columns.values()]))
    joints = {joint.get("name"): joint for joint in root.findall("joint") if joint.get("type") in MOTION_KINDS}
    try:
        for line, values in read if not table.findings else ():
            row = by_line[line]
            name = row.get("joint", "")
            sizes = {number: values[column.name] for number, column in columns.items() if column.name in values}
            if name in joints:
                gear = _put(reader, joints[name], columns, sizes, line)
                found[name] = Row(Motor(row.get("motor", ""), tuple(sizes)), gear, line)
    except SourceError as error:
        table.findings += error.diagnostics
    for finding in table.findings:
        line = finding.line if finding.line in by_line else reader.element_lines[header]
        reader.diagnostics.append(msgspec.structs.replace(finding, line=line))
    return found


def _put(
    reader: Reader, joint: Element, columns: Mapping[MotorNumber, Any], values: Mapping[MotorNumber, Any], line: int
) -> Mapping[str, float]:
    """Put the numbers of a row into the elements of its joint; return those of its gear. Raises SourceError."""
    from urdfsync.table.units import Unit, is_same_kind

    kind, gear = MOTION_KINDS[joint.get("type")], dict[str, float]()  # type: ignore[index] # see `joints`
    motion = "sliding" if kind == "translational" else "turning"
    if not values:
        raise SourceError.of("bad-cell", "the row has no number of a drive", "", line, hint="fill its cells")
    for number, value in values.items():
        column, (field, *units) = columns[number], _PLACES[number]
        unit = column.type.si if isinstance(column.type, Unit) else "1" if column.type == "integer" else "text"
        expected = units[motion == "sliding"]
        if unit == "text" or not is_same_kind(unit, expected):
            message = f"column `{column.name}` is in {unit}, and the {number} of a {motion} joint is in {expected}"
            raise SourceError.of("bad-unit", message, hint="correct its unit, or name another column")
        if value < 0 if number != "reduction" else not value:
            message = f"column `{column.name}`: {value:g} is no {number}"
            raise SourceError.of("bad-cell", message, "", line, hint="correct the cell")
        if field == "transmission":
            gear[number] = float(value)
            continue
        part = next((joint.find(path) for path in (field, f"axis/{field}") if joint.find(path) is not None), None)
        if part is None and field == "limit" and joint.get("type") != "continuous":
            message = f"joint `{joint.get('name')}` has no <limit>, and a row can't give it limits of position"
            raise SourceError.of("no-limit", message, "", line, hint="give it lower and upper in the URDF")
        if part is None:
            part = SubElement(joint, field)
            reader.element_lines = {**reader.element_lines, part: line}
        part.set(number, repr(float(value)))
    return gear


def with_row(reader: Reader, joint: Joint, row: Row | None) -> Joint:
    """Return a joint with the gear of its row."""
    if row is None:
        return joint
    gear = msgspec.structs.replace(joint.transmission or Transmission(), **row.gear)
    if gear.joint is not None and "reduction" in row.gear:
        message = f"the motor of joint `{joint.name}` moves `{gear.joint}`, too: a row can't give its reduction"
        found = Diagnostic(Severity.ERROR, "bad-cell", message, line=row.line, hint="leave its cell empty")
        reader.diagnostics.append(found)
    return msgspec.structs.replace(joint, motor=row.motor, transmission=None if gear == Transmission() else gear)
