"""Reads a catalogue: each row has the numbers of one motor, such as rotor, gear and limits.

The option `motors` names rows. Each of these rows goes to the end of the URDF, with its units:

    <catalogue_row joint="elbow" motor="S41" effort="410 [N.cm]" rotor_inertia="0.6 [g.cm2]"/>

So each reader of the URDF sees the rows and their lines, and converts the units itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement

import msgspec

from urdfsync.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.spelling import name_and_unit, nearest
from urdfsync.urdf.options import MotorNumber, Options
from urdfsync.urdf.parse.fields import Reader
from urdfsync.urdf.robot import MOTION_KINDS, Joint, Motor, Transmission

OPTION = "catalogue"
_ROW = "catalogue_row"
_PLACES: Mapping[MotorNumber, tuple[str, str, str]] = {
    "effort": ("limit", "N.m", "N"),
    "velocity": ("limit", "rad/s", "m/s"),
    "damping": ("dynamics", "N.m.s/rad", "N.s/m"),
    "friction": ("dynamics", "N.m", "N"),
    "armature": ("dynamics", "kg.m2", "kg"),
    "reduction": ("transmission", "1", "rad/m"),
    "rotor_inertia": ("transmission", "kg.m2", "kg.m2"),
}
"""Numbers of a row: the field of `Joint` with the number, and the units of a turning and of a sliding joint."""
NUMBERS: Mapping[tuple[str | int, ...], str] = {(field, number): number for number, (field, _, _) in _PLACES.items()}
"""Numbers of a row by their paths in a joint."""


class Row(NamedTuple):
    """A row of the catalogue for one joint. The joint's elements have all numbers but those of the gear."""

    motor: Motor
    gear: Mapping[str, float]
    line: int


def file(options: Options) -> str:
    """Return the path of the catalogue from the configuration's folder; empty if no joint needs it."""
    return options.catalogue if options.motors else ""


def join(content: bytes, other: bytes, file: str, options: Options) -> tuple[bytes, Sequence[tuple[int, int]]]:
    """Return the URDF with the rows before the last tag, and the line of each row in both files; see `NamedFile`.

    The check of options reports missing rows. Raises SourceError for any other fault of the table.
    """
    if (end := content.rfind(b"</robot")) < 0:
        return content, ()
    elements, first = list(_elements(other, file, options)), content.count(b"\n", 0, end) + 2
    lines = "".join(f"\n{element}" for element, _ in elements).encode("ascii", "xmlcharrefreplace")
    places = [(number, line) for number, (_, line) in enumerate(elements, first)]
    return content[:end] + lines + b"\n" + content[end:], places


def _elements(content: bytes, file: str, options: Options) -> Iterator[tuple[str, int]]:
    """Yield the element of each joint, and its line in the catalogue."""
    from xml.sax.saxutils import quoteattr  # a late import saves most robots 9 ms

    from urdfsync.table.formats import read_sheets, with_decimal_points  # likewise

    sheet, _ = read_sheets(content, file)
    header = [name_and_unit(cell) for cell in sheet.header]
    sheet = with_decimal_points(sheet, [n for n, (_, unit) in enumerate(header) if unit not in ("", "text")], file)
    names, columns = [name for name, _ in header], dict[MotorNumber, Sequence[str]]()
    for number in _PLACES:
        named = options.motor_columns.get(number, number)
        columns[number] = (named,) if isinstance(named, str) else named
        if missing := [column for column in columns[number] if column not in names and column != number]:
            near = nearest(missing[0], names)
            hint = f"did you mean `{near}`?" if near else "correct `motor_columns`"
            raise SourceError.of("no-column", f"there is no column `{missing[0]}`", file, 1, hint=hint)
    rows = dict[str, tuple[int, list[str]]]()
    for line, cells in sheet.rows:
        texts = ["" if cell is None else str(cell).strip() for cell in cells]
        if texts[0] in rows and texts[0] in options.motors.values():
            message = f"the row `{texts[0]}` stands in line {rows[texts[0]][0]}, too"
            raise SourceError.of("bad-row", message, file, line, hint="rename one")
        rows[texts[0]] = line, texts
    for joint, name in options.motors.items():
        line, texts = rows.get(name, (0, names))
        if len(texts) != len(names):
            message = f"the row `{name}` has {len(texts)} cells, but the header has {len(names)}"
            raise SourceError.of("bad-row", message, file, line, hint="fill each cell, or quote its text")
        filled = {column: f"{text} [{unit}]" for (column, unit), text in zip(header, texts, strict=True) if text}
        found = {"joint": joint, "motor": name}
        for key, alternatives in columns.items():
            if column := next(filter(filled.__contains__, alternatives), ""):
                found[key] = filled.pop(column)
                if found[key].endswith(" []"):
                    message, hint = f"the column `{column}` has no unit", f"write `{column} [{_PLACES[key][1]}]`"
                    raise SourceError.of("bad-row", message, file, 1, hint=hint)
        unused = [column for column, unit in header if column in filled and unit not in ("", "text")]
        found |= {"unused": ", ".join(unused)} if unused else {}
        if name in rows:
            words = (f"{key}={quoteattr(''.join(filter(str.isprintable, text)))}" for key, text in found.items())
            yield f"<{_ROW} {' '.join(words)}/>", line


def read_rows(reader: Reader, root: Element) -> Mapping[str, Row]:
    """Put the numbers of the catalogue's rows into the elements of their joints; return the rows by joint.

    The rows leave the document. A row of a joint without an axis is ignored: the check of options reports this row.
    Only the first fault becomes a diagnostic, since a wrong unit is a fault in each row.
    """
    joints = {joint.get("name"): joint for joint in root.findall("joint") if joint.get("type") in MOTION_KINDS}
    rows, found = root.findall(_ROW), dict[str, Row]()
    for element in rows:
        root.remove(element)
    for element in (row for row in rows if row.get("joint") in joints):
        line = reader.element_lines[element]
        try:
            found[element.get("joint", "")] = _read_row(reader, element, joints[element.get("joint")], line)
        except SourceError as error:
            reader.diagnostics += [msgspec.structs.replace(fault, line=line) for fault in error.diagnostics]
            break
    if unused := dict.fromkeys(name for row in rows for name in row.get("unused", "").split(", ") if name):
        message = f"no joint takes these columns of the catalogue: {', '.join(f'`{name}`' for name in unused)}"
        hint = "name a column in `motor_columns` if it is a number of a drive"
        line = reader.element_lines[next(row for row in rows if row.get("unused"))]
        reader.diagnostics.append(Diagnostic(Severity.NOTE, "unused", message, "", line, hint=hint))
    motions = {name: MOTION_KINDS[joints[name].get("type")] for name in found}  # type: ignore[index] # see `joints`
    reader.diagnostics += _find_empty_cells(found, motions)
    return found


def _find_empty_cells(rows: Mapping[str, Row], motions: Mapping[str, str]) -> Iterator[Diagnostic]:
    """Yield a note for each row without an effort or a velocity, if a row of another such joint has one."""
    for number in ("effort", "velocity"):
        filled = {motions[name] for name, row in rows.items() if number in row.motor.numbers}
        for name, row in rows.items():
            if motions[name] in filled and number not in row.motor.numbers:
                message = f"the row `{row.motor.row}` has no {number}: that of joint `{name}` in the source counts"
                yield Diagnostic(Severity.NOTE, "empty-cell", message, "", row.line, hint="fill the cell")


def _read_row(reader: Reader, element: Element, joint: Element, line: int) -> Row:
    """Put the numbers of a row into the elements of its joint. Raises SourceError."""
    gear, name, own = dict[str, float](), element.get("motor", ""), joint.get("name", "")
    numbers = [number for number in _PLACES if number in element.attrib]
    if not numbers:
        hint = "fill cells of the row, or name columns in `motor_columns`"
        raise SourceError.of("bad-row", f"the row `{name}` has no number of a drive", hint=hint)
    for number in numbers:
        field, *units = _PLACES[number]
        part = next((part for part in map(joint.find, (field, f"axis/{field}")) if part is not None), None)
        if part is None and field == "limit" and joint.get("type") != "continuous":
            message = f"joint `{own}` has no <limit>: the row `{name}` gives no limits of position"
            raise SourceError.of("bad-row", message, hint="write the joint's <limit> in the URDF")
        try:
            size = _in_si(number, element.get(number, ""), units[MOTION_KINDS[joint.get("type")] == "translational"])  # type: ignore[index] # see `joints`
        except ValueError as error:
            message = f"{number} of joint `{own}` in the row `{name}`: {error}"
            raise SourceError.of("bad-row", message, hint="correct the catalogue, or `motor_columns`") from None
        if field == "transmission":
            gear[number] = size
            continue
        if part is None:
            part = SubElement(joint, field)
            reader.element_lines = {**reader.element_lines, part: line}
        part.set(number, repr(size))
    return Row(Motor(name, tuple(numbers)), gear, line)


def _in_si(number: MotorNumber, text: str, expected: str) -> float:
    """Return a number with a unit, such as `410 [N.cm]`, in the `expected` unit. Raises ValueError or SourceError."""
    from urdfsync.table.reading import read_value  # a late import saves most robots 15 ms
    from urdfsync.table.units import find_unit, is_same_kind

    cell, unit = name_and_unit(text)
    unit = "1" if unit == "integer" else unit
    if not is_same_kind(unit, expected):
        raise ValueError(f"{unit} can't be converted to {expected}")
    found = find_unit(unit)
    if expected.startswith("rad") and "rad" not in found.si:  # pint reads 1/min as rad/min, data sheets mean rpm
        raise ValueError(f"write `turn` or `rad` in {unit}")
    size = float(read_value(cell, found) or 0)
    if size < 0 if number != "reduction" else not size:
        raise ValueError(f"{cell} is too small")
    return size


def with_row(reader: Reader, joint: Joint, row: Row | None) -> Joint:
    """Return the joint with the gear of its row."""
    if row is None:
        return joint
    gear = msgspec.structs.replace(joint.transmission or Transmission(), **row.gear)
    if gear.joint is not None and "reduction" in row.gear:
        message = f"the motor of joint `{joint.name}` also moves `{gear.joint}`: a row can't give its reduction"
        fault = SourceError.of("bad-row", message, "", row.line, hint="leave the cell of the reduction empty")
        reader.diagnostics += fault.diagnostics
    return msgspec.structs.replace(joint, motor=row.motor, transmission=None if gear == Transmission() else gear)
